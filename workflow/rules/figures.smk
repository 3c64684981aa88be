# What the scripts of figures read, and which of them are drawn in one job.


def figure_script(name):
    """The script of a figure, named as PAPER/FIGURE; exits in one line if there is none."""
    script = f"figures/{name}.py"
    if not Path(script).exists():
        sys.exit(f"error: --config: figure: there is no script {script}; give figure=PAPER/FIGURE")
    return script


def figure_scripts(paper):
    """The scripts of a paper's figures."""
    return sorted(str(path) for path in Path("figures", paper).glob("*.py"))


def needs(name):
    """What a figure's script says that it reads."""
    return constants(figure_script(name))["NEEDS"]


def caption(name):
    """What a figure's script says that it shows."""
    # The report has it inside a script of its own.
    return constants(figure_script(name))["CAPTION"].replace("</", "< /")


def study_figure_files():
    """Pictures that every study has."""
    return [
        f"{FIGURES}/studies/{study}/{kind}.png"
        for study in STUDIES
        for kind in ("over_k", "over_sweep", "distribution")
    ]


def is_drawn(name):
    """Whether a figure is part of a run; in a smoke run only if all that it reads is there."""
    needed = needs(name)
    if needed.get("on_request"):
        return False
    if not SMOKE:
        return True
    points = needed.get("points", {})
    ran = REGISTRY.catalogue(*points)
    # Of more than one point of a family, or of points that are left out.
    of_many = ("diff", "tables", "convergence", "mismatch", "consistency", "bounds")
    whole = any(map(needed.get, of_many))
    return not whole and all(ran[s].keys() >= {*points[s]} for s in points)


def studies_read(names):
    """Studies that figures read; all of them if they read the verdicts or the leaderboard."""
    read = {}
    for needed in map(needs, names):
        if needed.get("diff") or needed.get("leaderboard"):
            return [*STUDIES]
        of = [needed.get(what, []) for what in ("tables", "points", "consistency", "bounds")]
        read |= dict.fromkeys(study for studies in of for study in studies)
    return sorted(read.keys() & STUDIES.keys())


def sheet(name):
    """Figures that read the same studies are drawn in one job, which is named so."""
    needed = needs(name)
    if needed.get("on_request"):
        return "_".join(Path(name).parts)
    if needed.get("leaderboard"):
        return "leaderboard"
    if needed.get("diff"):
        return "verdicts"
    if needed.get("convergence") or needed.get("mismatch"):
        return "own_tables"
    if needed.get("consistency") or needed.get("bounds"):
        return "consistency"
    return "_".join(studies_read([name])) or "of_no_study"


def sheets():
    """Figures by the job that draws them: those of a run, and those that are drawn on request."""
    found = {}
    for path in sorted(Path("figures").glob("*/*.py")):
        name = f"{path.parent.name}/{path.stem}"
        if is_drawn(name) or needs(name).get("on_request"):
            found.setdefault(sheet(name), []).append(name)
    return found


def figure_files():
    """Pictures of the figures that are part of a run."""
    return [
        f"{FIGURES}/{name}.png" for names in SHEETS.values() for name in filter(is_drawn, names)
    ]


def figure_inputs(names):
    """The files that the figures' scripts say that they read."""
    files = {}
    for needed in map(needs, names):
        tables = needed.get("tables", [])
        found = [LAYOUT.table(study) for study in tables]
        found += [LAYOUT.curves(study) for study in tables if study in STUDIES]
        for study, points in needed.get("points", {}).items():
            found += [*REGISTRY.log_files(study, points), *REGISTRY.run_files(study, points)]
        found += [LAYOUT.convergence(study) for study in needed.get("convergence", [])]
        found += [LAYOUT.mismatch(study) for study in needed.get("mismatch", [])]
        found += needed.get("measured", [])
        found += [LAYOUT.consistency(study) for study in needed.get("consistency", [])]
        found += [LAYOUT.bounds(study) for study in needed.get("bounds", [])]
        found += [LAYOUT.calibration(f"{name}.csv") for name in needed.get("calibration", [])]
        if needed.get("leaderboard"):
            found += [LAYOUT.page("leaderboard.csv")]
        if needed.get("diff"):
            found += [LAYOUT.page("diff.csv"), LAYOUT.page("robustness.csv")]
            found += [LAYOUT.claims(paper) for paper in JUDGED]
        files |= dict.fromkeys(found)
    return list(files)
