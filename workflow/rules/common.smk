# Configuration, parameters and paths, and what the rules are written with.
import os
import subprocess
import sys
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
from repro.origin import digest
from repro.parameters.load import (
    check_shards,
    first_of_families,
    load_paper,
    load_run,
    user_values,
    whose_logs,
)
from repro.parameters.point_names import is_plain, is_reading, own_table
from repro.parameters.readings import readings_of
from repro.workflow.code import code_digest, code_files, constants, source_digest
from repro.workflow.lock import hold, runs_jobs, sweep
from repro.workflow.registry import Registry
from repro.workflow.unnamed_logs import unseen_changes


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
LEFT_OUT = {
    study: points.keys() - first_of_families(points) if SMOKE else set()
    for study, points in STUDIES.items()
}
# Points that are simulated with the same values share the log of one of them.
LOG_OF = {
    study: whose_logs({name: points[name] for name in points if name not in LEFT_OUT[study]})
    for study, points in STUDIES.items()
}
REGISTRY = Registry(LAYOUT, STUDIES, RUN.shards, LEFT_OUT, LOG_OF)
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


def results_of(studies, requested=False, table=""):
    """Parameter: how a job finds what other jobs have left of the studies: Results(**this).

    Which points it knows of: see `Registry.catalogue`.
    """
    return {
        "root": str(LAYOUT.root),
        "catalogue": REGISTRY.catalogue(*studies, requested=requested, table=table),
        "shards": RUN.shards,
        "studies": {study: DESCRIBED[study] for study in studies},
        "own_filters": REGISTRY.own_filters(RANKED),
        "tolerance": RUN.tolerance,
        "origins": {study: origins(study, requested, table) for study in studies},
    }


def paper_runs(paper):
    """The runs of all filters on all points of a paper."""
    return [file for study in PAPERS[paper].studies for file in REGISTRY.run_files(study)]


def paper_logs(paper):
    """Of each job that makes logs of a paper: the one that stands for all of them."""
    return [file for study in PAPERS[paper].studies for file in REGISTRY.log_marks(study)]


def results_with(studies, requested=False, table=""):
    """Parameter: digest of that, which is what Snakemake records: see origins.smk."""
    of_studies = [results_of_study_with(study, requested, table) for study in studies]
    return digest(of_studies, RUN.shards, REGISTRY.own_filters(RANKED), RUN.tolerance)


@cache
def results_of_study_with(study, requested, table):
    filters = REGISTRY.catalogue(study, requested=requested, table=table)
    return digest(filters, DESCRIBED[study], origins(study, requested, table))


VERDICTS_FROM = {"claims", "facts", "tables"}


def judged_by(paper):
    """Modules of a paper that its verdicts come from; it may have no facts and no tables."""
    own = SOURCE / "repro/papers" / paper
    names = {path.stem for path in own.glob("*") if path.suffix == ".py" or path.is_dir()}
    return [f"repro.papers.{paper}.{name}" for name in sorted(names & VERDICTS_FROM)]


def plain_points(study):
    """Parameters, and settings by filter, of each point of a study, as JSON has them."""
    return {
        name: {"parameters": plain_parameters(study, name), "filters": point.filters}
        for name, point in STUDIES[study].items()
    }


# Tables that come from no trials, by paper: filled by the papers' own rules.
COMPUTED_TABLES = {paper: [] for paper in PAPERS}
# What `snakemake calibration` makes: filled likewise.
CALIBRATIONS = []


def judged_points(study):
    """Points of a study at which the filters' own covariances are judged, as far as they run."""
    return [point for point in DESCRIBED[study]["consistency"] if point not in LEFT_OUT[study]]


def table_files(paper):
    """Tables of a paper: of its studies, and computed ones."""
    return [LAYOUT.table(name) for name in (*PAPERS[paper].studies, *COMPUTED_TABLES[paper])]


def measured_files(paper):
    """Measurements of a machine, which no rule of a rebuild makes again."""
    return sorted(str(path) for path in Path("params/measured").glob(f"{paper}*.csv"))


def asked_for(key):
    """What --config says of a figure, of root seeds, or of a log recorded elsewhere."""
    value = getattr(RUN, key)
    if value is None:
        of_log = "log=PATH study=STUDY point=POINT"
        usages = {"figure": "figure=PAPER/FIGURE", "seeds": 'seeds="1 2 3"'}
        usage = usages.get(key, of_log)
        sys.exit(f"error: --config: '{key}' is missing; give {usage}")
    return value


def asked_seeds():
    """The root seeds that --config names."""
    return str(asked_for("seeds")).split()


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
