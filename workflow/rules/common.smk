# Configuration, parameters and paths, and what the rules of the filters are written with.
import os
import subprocess
import sys
from pathlib import Path

SOURCE = Path(workflow.basedir) / "src"
# Before any installed copy, for this process and for its jobs: the code is this folder's.
sys.path.insert(0, str(SOURCE))
SEARCHED = os.pathsep.join(filter(None, [str(SOURCE), os.environ.get("PYTHONPATH")]))
os.environ.update(PYTHONPATH=SEARCHED)
# Jobs share the cores; threads inside a job would compete and change the rounding of sums.
os.environ.update(OPENBLAS_NUM_THREADS="1", OMP_NUM_THREADS="1", MKL_NUM_THREADS="1")
# glibc gives freed memory back at once by default; arrays of every step would cost page faults.
os.environ.update(MALLOC_TRIM_THRESHOLD_="268435456", MALLOC_MMAP_THRESHOLD_="268435456")

from repro.catalogue import matching_points
from repro.errors import ReproError
from repro.lock import hold
from repro.params import load_paper, load_run
from repro.sources import code_digest, constants
from repro.whole import check_writable

if workflow.is_main_process:
    try:
        ALIVE = hold(".snakemake")
    except OSError as error:
        sys.exit(f"error: {error.filename}: {error.strerror}: Snakemake keeps its records there")

PARAMETER_FILES = sorted(path for path in Path("params").glob("*.yaml") if path.name != "run.yaml")
try:
    RUN = load_run("params/run.yaml", "workflow/schemas", dict(config))
    PAPERS = {path.stem: load_paper(path, "workflow/schemas") for path in PARAMETER_FILES}
except ReproError as error:
    sys.exit(f"error: {error}")

STUDIES = {study: points for paper in PAPERS.values() for study, points in paper.studies.items()}
if "trials" in RUN:
    for points in STUDIES.values():
        for point in points.values():
            point.parameters.update(trials=RUN["trials"])
for study, points in STUDIES.items():
    for name, point in points.items():
        if RUN["shards"] > point.parameters["trials"]:
            sys.exit(
                f"error: shards: {RUN['shards']} are more than the {point.parameters['trials']} "
                f"trials of {study}, point {name}; mend params/run.yaml or --config"
            )
SHARDS = range(RUN["shards"])
RESULTS = f"{RUN['into']}/results" if "into" in RUN else "results"
FIGURES = f"{RUN['into']}/figures" if "into" in RUN else "figures"
try:
    check_writable(RESULTS)
    check_writable(FIGURES)
except ReproError as error:
    sys.exit(f"error: {error}")
LOG = f"{RESULTS}/logs/{{study}}/{{point}}/{{shard}}.mcap"
FLIGHT = f"{RESULTS}/flights/{{study}}/{{point}}/{{filter}}/{{shard}}.mcap"
ENVIRONMENT = "../envs/repro.yaml"
RUN_FILTER = "../scripts/run_filter.py"

# Points of this name take minutes: they run only for the sensitivity table that asks for them.
ON_REQUEST = "sensitivity-"
# Which filters run on which points: filled by runs(), in the order of the rules.
CATALOGUE, REQUESTED = (
    {
        study: {point: [] for point in points if point.startswith(ON_REQUEST) == requested}
        for study, points in STUDIES.items()
    }
    for requested in (False, True)
)
# Studies in which the filters fly: filled in by flights().
CLOSED_LOOPS = set()


wildcard_constraints:
    study="[a-z0-9_]+",
    point="[^/]+",
    shard="[0-9]+",
    paper="[a-z0-9_]+",
    figure="[a-z0-9_]+",


def runs(name, studies, points="*", skip=()):
    """Output of a filter's rule. Registers the filter on the studies' points that match."""
    for study in studies:
        if study not in CATALOGUE:
            known = ", ".join(CATALOGUE)
            sys.exit(f"error: filter {name}: there is no study '{study}'; known are {known}")
        of_study = {**CATALOGUE[study], **REQUESTED[study]}
        matching = matching_points(of_study, points, skip)
        if not matching:
            sys.exit(
                f"error: filter {name}: no point of {study} matches {points}; mend the pattern"
            )
        for point in matching:
            of_study[point].append(name)
    return f"{RESULTS}/runs/{{study,{'|'.join(studies)}}}/{{point}}/{name}/{{shard}}.npz"


def flights(name, studies):
    """Second output where a filter closes a loop: the log of what was flown."""
    CLOSED_LOOPS.update(studies)
    return FLIGHT.replace("{filter}", name)


def flight_files(study, point):
    """Logs of what the filters flew; none in an open loop."""
    filters = CATALOGUE[study][point] if study in CLOSED_LOOPS else []
    return expand(FLIGHT, study=study, point=point, filter=filters, shard=SHARDS)


def settings(name):
    """Settings of a paper's filter at the point, from params/."""
    return lambda wildcards: STUDIES[wildcards.study][wildcards.point].filters.get(name, {})


def code(*modules):
    """Parameter: the code that the modules reach, the study's with it; {paper} is filled in.

    A digest, not input files: some thirty a job would cost the scheduler more than the jobs take.
    """

    def digest(wildcards):
        found = dict(wildcards.items())
        study = [f"repro.studies.{found['study']}"] if "study" in found else []
        return code_digest("repro.job", *(module.format(**found) for module in modules), *study)

    return digest


def logfile(rule, *wildcards):
    """Log of a job: its usage, or the one line of its fault."""
    return _place("job_logs", rule, wildcards, "log")


def timing(rule, *wildcards):
    """Benchmark file of a job."""
    return _place("timings", rule, wildcards, "tsv")


def _place(folder, rule, wildcards, ending):
    parts = [f"{{{name}}}" for name in wildcards or ("study", "point", "shard")]
    return str(Path(RESULTS, folder, rule, *parts)) + f".{ending}"


def trial_range(study, point, shard):
    """First and last + 1 of the trials of a shard."""
    trials = STUDIES[study][point].parameters["trials"]
    shard, shards = int(shard), len(SHARDS)
    return shard * trials // shards, (shard + 1) * trials // shards


def catalogue(*studies):
    """The registered filters of the studies, without points that have none."""
    return {
        study: {point: filters for point, filters in CATALOGUE[study].items() if filters}
        for study in studies
    }


def run_files(study, points=None):
    """Runs of all registered filters on the given (or all) points of a study."""
    return [
        f"{RESULTS}/runs/{study}/{point}/{name}/{shard}.npz"
        for point, filters in CATALOGUE[study].items()
        if points is None or point in points
        for name in filters
        for shard in SHARDS
    ]


def sensitivity_runs(study):
    """Runs of the base point and of the points on request."""
    points = {"base": CATALOGUE[study]["base"], **REQUESTED[study]}
    return [
        f"{RESULTS}/runs/{study}/{point}/{name}/{shard}.npz"
        for point, filters in points.items()
        for name in filters
        for shard in SHARDS
    ]


def log_files(study, points=None):
    """Logs of the given (or all) points of a study that a filter runs on."""
    return [
        LOG.format(study=study, point=point, shard=shard)
        for point, filters in CATALOGUE[study].items()
        if filters and (points is None or point in points)
        for shard in SHARDS
    ]


# Tables that come from no trials, by paper.
COMPUTED_TABLES = {"packet_delays": ["packet_example"], "unknown_losses": ["complexity"]}


def table_files(paper):
    """Tables of a paper: of its studies, and computed ones."""
    tables = [*PAPERS[paper].studies, *COMPUTED_TABLES.get(paper, [])]
    return [f"{RESULTS}/tables/{table}.csv" for table in tables]


def figure_files():
    """Pictures of every figure script that is not drawn on request: the papers', the overview's."""
    return [
        f"{FIGURES}/{path.parent.name}/{path.stem}.png"
        for path in sorted(Path("figures").glob("*/*.py"))
        if not constants(str(path))["NEEDS"].get("on_request")
    ]


def studies_of(paper):
    """Studies of a paper; of all papers for the overview."""
    return PAPERS[paper].studies if paper in PAPERS else STUDIES


def figure_inputs(wildcards):
    """What a figure's script says that it reads."""
    needs = constants(f"figures/{wildcards.paper}/{wildcards.figure}.py")["NEEDS"]
    tables = needs.get("tables", [])
    files = [f"{RESULTS}/tables/{study}.csv" for study in tables]
    files += [f"{RESULTS}/curves/{study}.csv" for study in tables if study in STUDIES]
    for study, points in needs.get("points", {}).items():
        files += [*log_files(study, points), *run_files(study, points)]
    files += needs.get("measured", [])
    if needs.get("diff"):
        files += [f"{RESULTS}/diff.csv", *(f"{RESULTS}/claims/{paper}.csv" for paper in PAPERS)]
    return files


def measured_files(paper):
    """Measurements of a machine, which no rule of a rebuild makes again."""
    return sorted(str(path) for path in Path("params/measured").glob(f"{paper}*.csv"))


def asked(key):
    """What --config says of a log of one's own: log, study or point."""
    if key not in RUN:
        sys.exit(f"error: --config: '{key}' is missing; give log=PATH study=STUDY point=POINT")
    return RUN[key]


def asked_point():
    """The resolved point that a log of one's own is of."""
    study, point = asked("study"), asked("point")
    if point not in STUDIES.get(study, {}):
        known = ", ".join(STUDIES.get(study, STUDIES))
        sys.exit(f"error: --config: there is no study '{study}' with a point '{point}': {known}")
    return STUDIES[study][point]


def commit():
    """The commit of the code and parameters, with -dirty where they differ from it."""
    said = subprocess.run(
        ["git", "rev-parse", "HEAD"], capture_output=True, text=True, cwd=workflow.basedir
    )
    if said.returncode != 0:
        return "unknown"
    changed = subprocess.run(
        ["git", "status", "--porcelain", "--", "Snakefile", "workflow", "src", "params"],
        capture_output=True,
        text=True,
        cwd=workflow.basedir,
    )
    return said.stdout.strip() + ("-dirty" if changed.stdout.strip() else "")


def print_tally():
    """The verdicts at a glance, at the end of a run."""
    tally = Path(RESULTS) / "tally.txt"
    if tally.exists():
        print(tally.read_text(), end="")
