# Configuration, parameters and paths, and what the rules are written with.
import os
import subprocess
import sys
import threading
from functools import cache
from pathlib import Path

SOURCE = Path(workflow.basedir) / "src"
# Before any installed copy, for this process and for its jobs: the code is this folder's.
sys.path.insert(0, str(SOURCE))
SEARCHED = os.pathsep.join(filter(None, [str(SOURCE), os.environ.get("PYTHONPATH")]))
os.environ.update(PYTHONPATH=SEARCHED)
# Jobs share the cores; threads inside a job would compete and change the rounding of sums.
os.environ.update(OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1", MKL_NUM_THREADS="1")
# Text files are UTF-8 in any locale.
os.environ.update(PYTHONUTF8="1")
# glibc gives freed memory back at once by default; arrays of every step would cost page faults.
os.environ.update(MALLOC_TRIM_THRESHOLD_="268435456", MALLOC_MMAP_THRESHOLD_="268435456")

from repro.atomic import check_writable
from repro.errors import ReproError
from repro.layout import Layout
from repro.parameters.load import (
    check_shards,
    first_of_families,
    load_paper,
    load_run,
    user_values,
)
from repro.origin import digest, of_shard, origin
from repro.parameters.point_names import on_request
from repro.provenance.records import Records
from repro.workflow.code import code_digest, code_files, constants, source_digest
from repro.workflow.lock import hold, runs_jobs, sweep
from repro.workflow.memory_and_disk import check_needs, estimated_needs, free
from repro.workflow.registry import Registry


def or_exit(function, *arguments, **named):
    """What the function returns; its ReproError ends Snakemake in one line."""
    try:
        return function(*arguments, **named)
    except ReproError as error:
        sys.exit(f"error: {error}")


PARAMETER_FILES = sorted(path for path in Path("params").glob("*.yaml") if path.name != "run.yaml")
RUN = or_exit(load_run, "params/run.yaml", dict(config))
PAPERS = {path.stem: or_exit(load_paper, path) for path in PARAMETER_FILES}
STUDIES = {
    study: {
        name: point if RUN.trials is None else point.with_trials(RUN.trials)
        for name, point in points.items()
    }
    for paper in PAPERS.values()
    for study, points in paper.studies.items()
}
if RUN.one_point_per_family:
    STUDIES = {
        study: {name: point.shortened() for name, point in points.items()}
        for study, points in STUDIES.items()
    }
DESCRIBED = {study: paper.described(study) for paper in PAPERS.values() for study in paper.studies}
or_exit(check_shards, STUDIES, RUN.shards)
LAYOUT, FIGURES = Layout(Path(RUN.into, "results")), str(Path(RUN.into, "figures"))
or_exit(check_writable, LAYOUT.root)
or_exit(check_writable, FIGURES)
RUNS_JOBS = workflow.is_main_process and runs_jobs(sys.argv[1:])
if RUNS_JOBS:
    try:
        or_exit(hold, ".snakemake", LAYOUT.root)
    except OSError as error:
        sys.exit(f"error: {error.filename}: {error.strerror}: a run keeps its records there")
    sweep(LAYOUT.root)
    sweep(FIGURES)
# With one point of each family there is nothing to compare: no claims, no diff.
SMOKE = RUN.one_point_per_family
LEFT_OUT = {study: points.keys() - first_of_families(points) for study, points in STUDIES.items()}
REGISTRY = Registry(LAYOUT, STUDIES, RUN.shards, LEFT_OUT if SMOKE else None)
# Filters that some parameter file ranks; all others are a reader's own.
RANKED = {
    f for paper in PAPERS.values() for ranking in paper.ranking.values() for f in ranking.known()
}
# Filters that a study's parameter file lists, by study.
LISTED = {study: names for paper in PAPERS.values() for study, names in paper.run.items() if names}
# Papers with printed values or claims; a study of one's own may have neither.
JUDGED = [paper for paper in PAPERS if Path("params/published", f"{paper}.csv").exists()]
ENVIRONMENT = str(Path(workflow.basedir, "workflow/envs/repro.yaml"))


wildcard_constraints:
    study="[a-z0-9_]+",
    point="[^/]+",
    batch="[a-z]+",
    filter="[a-z0-9_]+",
    shard="[0-9]+",
    paper="[a-z0-9_]+",
    figure="[a-z0-9_]+",


def runs(name, studies, points="*", skip=()):
    """Output of a filter's rule: the filter runs on the studies' points that match."""
    return or_exit(REGISTRY.runs, name, studies, points, skip)


def filtered_points(wildcards):
    """What a filter's job needs of each point of its batch: see `FilteredPoint`."""
    study, shard = wildcards.study, int(wildcards.shard)
    points = {}
    for point, made in in_batch(wildcards.filter, study, wildcards.batch).items():
        trials = of_shard(made["trials"], shard, RUN.shards)
        points[point] = {
            "log": LAYOUT.log(study, point, shard),
            "settings": made["settings"],
            "log_origin": origin(made["log"], trials),
            "origin": origin(made["runs"], trials),
        }
    return points


def filtered_logs(wildcards):
    """Logs of those points."""
    batch = in_batch(wildcards.filter, wildcards.study, wildcards.batch)
    return [LAYOUT.log(wildcards.study, point, wildcards.shard) for point in batch]


@cache
def in_batch(name, study, batch):
    """Of each point of a batch that the filter runs on: what is the same in all of its shards."""
    return {
        point: {
            "trials": STUDIES[study][point].parameters.trials,
            "settings": REGISTRY.settings(name, study, point),
            "log": log_made_with(study, point),
            "runs": runs_made_with(name, study, point),
        }
        for point in REGISTRY.in_batch(name, study, batch)
    }


@cache
def log_made_with(study, point):
    """Digest of what the trials of a point are simulated with."""
    simulation = or_exit(code_digest, "repro.simulate", f"repro.studies.{study}")
    return digest(study, point, plain_parameters(study, point), RUN.root_seed, simulation)


@cache
def runs_made_with(name, study, point):
    """Digest of what a filter's runs on a point are made with."""
    estimation = or_exit(code_digest, "repro.runner", f"repro.filters.{name}")
    settings = REGISTRY.settings(name, study, point)
    return digest(log_made_with(study, point), settings, estimation)


def check_records():
    """End Snakemake if the results are stale and it has no records to know it by."""
    records = Records(".snakemake", LAYOUT)
    or_exit(
        records.check,
        lambda: {study: origins(study, requested=True) for study in STUDIES},
        RUN.shards,
        source_digest,
    )
    if RUNS_JOBS:
        records.take()


def point_filters(wildcards):
    """Settings of each filter of a point."""
    return REGISTRY.all_settings(wildcards.study)[wildcards.study].get(wildcards.point, {})


def code(*modules):
    """Parameter: the code that the modules reach, the study's with it; wildcards are filled in.

    A digest, not input files: some thirty a job would cost the scheduler more than the jobs take.
    A module that does not exist ends Snakemake in one line.
    """
    or_exit(code_files, *(module for module in modules if "{" not in module))

    def reached_code(wildcards):
        values = dict(wildcards.items())
        study = [f"repro.studies.{values['study']}"] if "study" in values else []
        reached = (module.format(**values) for module in modules)
        return or_exit(code_digest, "repro.workflow.job", *reached, *study)

    reached_code.modules = modules
    return reached_code


def results_of(studies, requested=False):
    """Parameter: how a job finds what other jobs have left of the studies: Results(**this)."""
    return {
        "root": str(LAYOUT.root),
        "catalogue": REGISTRY.catalogue(*studies, requested=requested),
        "shards": RUN.shards,
        "studies": {study: DESCRIBED[study] for study in studies},
        "own_filters": REGISTRY.own_filters(RANKED),
        "tolerance": RUN.tolerance,
        "origins": {study: origins(study, requested) for study in studies},
    }


def origins(study, requested=False):
    """What the results of each point of a study must come from."""
    return {
        point: {
            "trials": STUDIES[study][point].parameters.trials,
            "log": log_made_with(study, point),
            "filters": {name: runs_made_with(name, study, point) for name in filters},
        }
        for point, filters in REGISTRY.catalogue(study, requested=requested)[study].items()
    }


def simulated_points(study, points, shard):
    """Parameters, trials and origin of a shard of the points."""
    simulated = {}
    for point in points:
        parameters = plain_parameters(study, point)
        trials = of_shard(parameters["trials"], shard, RUN.shards)
        simulated[point] = {
            "parameters": parameters,
            "trials": trials,
            "origin": origin(log_made_with(study, point), trials),
        }
    return simulated


@cache
def plain_parameters(study, point):
    """Parameters of a point, the same object in all of its shards."""
    return STUDIES[study][point].parameters.plain()


def studies_of(paper):
    """Studies of a paper; of all papers for the overview."""
    return PAPERS[paper].studies if paper in PAPERS else STUDIES


# Tables that come from no trials, by paper: filled by the papers' own rules.
COMPUTED_TABLES = {paper: [] for paper in PAPERS}


def table_files(paper):
    """Tables of a paper: of its studies, and computed ones."""
    return [LAYOUT.table(name) for name in (*PAPERS[paper].studies, *COMPUTED_TABLES[paper])]


def figure_script(name):
    """The script of a figure, named as PAPER/FIGURE; exits in one line if there is none."""
    script = f"figures/{name}.py"
    if not Path(script).exists():
        sys.exit(f"error: --config: figure: there is no script {script}; give figure=PAPER/FIGURE")
    return script


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
    if not SMOKE:
        return not needed.get("on_request")
    points = needed.get("points", {})
    ran = REGISTRY.catalogue(*points)
    whole = needed.get("diff") or needed.get("tables")  # of more than one point of a family
    return not whole and all(ran[s].keys() >= {*points[s]} for s in points)


def sheet(name):
    """Figures of a paper that read the same studies are drawn in one job, which is named so."""
    needed, paper = needs(name), Path(name).parent.name
    if needed.get("on_request"):
        return "_".join(Path(name).parts)
    if needed.get("diff") or needed.get("leaderboard"):
        return f"{paper}_verdicts"
    read = {*needed.get("tables", []), *needed.get("points", {})} & STUDIES.keys()
    return "_".join([paper, *sorted(read)])


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
        found += needed.get("measured", [])
        if needed.get("leaderboard"):
            found += [LAYOUT.page("leaderboard.csv")]
        if needed.get("diff"):
            found += [LAYOUT.page("diff.csv"), *(LAYOUT.claims(paper) for paper in JUDGED)]
        files |= dict.fromkeys(found)
    return list(files)


def measured_files(paper):
    """Measurements of a machine, which no rule of a rebuild makes again."""
    return sorted(str(path) for path in Path("params/measured").glob(f"{paper}*.csv"))


def asked_for(key):
    """What --config says of a figure, or of a log recorded elsewhere."""
    value = getattr(RUN, key)
    if value is None:
        of_log = "log=PATH study=STUDY point=POINT"
        usage = {"figure": "figure=PAPER/FIGURE"}.get(key, of_log)
        sys.exit(f"error: --config: '{key}' is missing; give {usage}")
    return value


def user_log_point():
    """The resolved point that a log recorded elsewhere is of."""
    study, point = asked_for("study"), asked_for("point")
    if point not in STUDIES.get(study, {}):
        known = ", ".join(STUDIES.get(study, STUDIES))
        sys.exit(f"error: --config: there is no study '{study}' with a point '{point}': {known}")
    return STUDIES[study][point]


def commit():
    """The commit of the code and parameters, with -dirty where they differ from it."""
    answer = subprocess.run(
        ["git", "rev-parse", "HEAD"], capture_output=True, text=True, cwd=workflow.basedir
    )
    if answer.returncode != 0:
        return "unknown"
    changed = subprocess.run(
        ["git", "status", "--porcelain", "--", "Snakefile", "workflow", "src", "params"],
        capture_output=True,
        text=True,
        cwd=workflow.basedir,
    )
    return answer.stdout.strip() + ("-dirty" if changed.stdout.strip() else "")


def print_needs():
    """What the run takes of memory and disk, at its start; ends it if less is free."""
    made = [file for job in workflow.dag.needrun_jobs() for file in job.output]
    local = workflow.local_exec
    needed = estimated_needs(made, LAYOUT, STUDIES, RUN.shards, workflow.cores if local else 1)
    if needed.jobs:
        print(or_exit(check_needs, needed, free(LAYOUT.root), LAYOUT.root, local=local))


def stop_timers():
    """End the timers of Snakemake's scheduler, for which its end would wait."""
    for thread in threading.enumerate():
        if isinstance(thread, threading.Timer):
            thread.cancel()


def print_tally():
    """The verdicts at a glance, at the end of a run."""
    if SMOKE:
        print(
            "Smoke run: the first point of each family, few trials; no claims, and no figures that "
            "compare points.\nEverything: snakemake -j2"
        )
        return
    tally = Path(LAYOUT.page("tally.txt"))
    if tally.exists():
        print(tally.read_text(encoding="utf-8"), end="")
