"""The workflow as its user meets it."""

import re
import shutil
import tomllib
from itertools import chain

import pytest
import yaml

from tests.conftest import ROOT
from tests.workflow.conftest import BUILT, FEW, STUDY, TABLE
from tests.workflow.test_pages import jobs_of


def test_lint_is_clean(project):
    assert "in a good condition" in project.snakemake("--lint")


def test_a_study_runs_end_to_end(built):
    """A study with few trials, up to its pictures; a second run has nothing to do.

    CI runs all papers with all trials, up to diff, manifest and tally, before these tests; claims
    and the other figures are in tests/papers.
    """
    assert "Nothing to be done" in built.snakemake(*BUILT, *FEW)
    written = [*BUILT, "results/tables/packet_example.csv"]
    written += ["results/ranking/linear_delays/table.csv", "results/curves/linear_delays.csv"]
    assert all((built.folder / file).stat().st_size > 0 for file in written)


def test_a_smoke_run_is_one_point_of_each_family(project):
    """The whole graph but verdicts, and filters that run on points left out alone."""
    profile = ("--profile", "profiles/smoke")
    planned = jobs_of(project.snakemake("-n", *profile))
    everything = jobs_of(project.snakemake("-n", "--config", "trials=6", "into=smoke"))
    left_out = everything.keys() - planned.keys()
    batches = ("figures_", "simulate_", "consistency_")
    assert {n for n in left_out if not n.startswith(batches)} == {
        *("claims", "diff", "robustness", "paper_verdicts", "emvf_realised"),
        *("tails", "convergence", "mismatch", "cost", "findings"),
    }
    assert "figures_deadband" not in left_out
    assert sum(planned.values()) < 0.8 * sum(everything.values())
    output = project.snakemake("smoke/results/parameters.csv", *profile)
    assert "Everything: snakemake -j2" in output


def test_a_rebuild_is_byte_identical(built):
    results = ["results/logs/*/*/*.mcap", "results/runs/*/*/*/*.npz", f"results/[tc]*/{STUDY}.csv"]
    results += ["figures/*/fig01.png"]
    first = built.bytes_of(*results)
    assert len(first) == 2 + 3 + 2 + 1
    for path in first:
        (built.folder / path).unlink()
    built.snakemake(TABLE, "figures/packet_delays/fig01.png", *FEW)
    assert built.bytes_of(*results) == first


def test_tables_do_not_depend_on_shards(paper):
    paper.keep_filters("omvf", "nahi")
    tables = []
    for shards in (1, 2):  # of 5 trials, and of 3 and 2
        into = f"shards{shards}"
        paper.snakemake(
            f"{into}/{TABLE}", "--config", "trials=5", f"shards={shards}", f"into={into}"
        )
        written = paper.bytes_of(f"{into}/results/tables/*.csv", f"{into}/results/curves/*.csv")
        assert len(written) == 2
        tables.append(list(written.values()))
    assert tables[0] == tables[1]


def test_an_edit_reruns_what_depends_on_it(built):
    with (built.folder / "src/repro/filters/nahi.py").open("a") as source:
        source.write("# edited\n")
    assert jobs_of(built.snakemake("-n", TABLE, *FEW)) == {"nahi": 1, "table": 1}


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ('steps: {value: 300, source: "', "steps: {value: 300, sauce: '", "not YAML"),
        ("[0.1, 0.2, 0.3,", "[0.1, 0.2, 1.3,", "arrival_probability: 1.3 is too large"),
        ("trials: {value: 400", "trials: {value: 0", "trials: 0 is too small"),
    ],
)
def test_bad_parameters_end_in_one_line_before_any_job(project, old, new, message):
    file = project.folder / "params" / "packet_delays.yaml"
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new, 1))
    output = project.snakemake(fails=True)
    (line,) = (line for line in output.splitlines() if line.startswith("error: "))
    assert "params/packet_delays.yaml" in line and message in line
    assert "Traceback" not in output and not (project.folder / "results").exists()


def test_more_shards_than_trials_end_in_one_line(project):
    output = project.snakemake("-n", TABLE, "--config", "trials=3", "shards=4", fails=True)
    (line,) = (line for line in output.splitlines() if line.startswith("error: "))
    assert "shards: 4 are more than the 3 trials of " in line and "Traceback" not in output
    few = ("--config", f"trials={10**6}", f"shards={10**5}")  # before its graph fills the memory
    last = project.snakemake("-n", TABLE, *few, fails=True).splitlines()[-1]
    assert last.endswith("shards: 100000 is too large; it must be at most 1000")
    project.snakemake("-n", TABLE, "--config", "trials=4", "shards=4")


def test_the_slurm_profile_names_only_rules_that_exist(project):
    profile = yaml.safe_load((project.folder / "profiles/slurm/config.yaml").read_text())
    rules = set(project.snakemake("--list-rules", "--quiet", "all").split())
    assert set(profile["set-resources"]) <= rules


def test_a_results_folder_that_cannot_be_written_ends_in_one_line(project):
    (project.folder / "results").write_text("not a folder")
    output = project.snakemake(TABLE, fails=True)
    (line,) = (line for line in output.splitlines() if line.startswith("error: "))
    assert "/results: not a folder that can be written" in line and "Traceback" not in output


def test_a_changed_log_ends_its_job_in_one_line(built):
    log = "results/logs/linear_delays/arrival=0.5/0.mcap"
    path = built.folder / log
    data = bytearray(path.read_bytes())
    data[len(data) // 2] ^= 1
    path.write_bytes(data)
    target = "results/runs/linear_delays/main/omvf/0.npz"
    output = built.snakemake(target, *FEW, fails=True)
    lines = [line for line in output.splitlines() if line.strip().startswith("error: ")]
    assert len(lines) == 1 and log in lines[0] and "/received" in lines[0]
    assert not (built.folder / target).exists()


def test_a_log_of_another_point_ends_its_job_in_one_line(built):
    logs = [f"results/logs/linear_delays/arrival={p}/0.mcap" for p in (0.5, 0.9)]
    shutil.copy(*(built.folder / log for log in logs))
    output = built.snakemake("results/runs/linear_delays/main/omvf/0.npz", *FEW, fails=True)
    assert "the log is of point 'arrival=0.5'" in output


def test_constraints_pin_every_package_by_its_plain_name_in_order():
    lines = (ROOT / "constraints.txt").read_text().split("\n")
    pins = [line for line in lines if line and not line.startswith("#")]
    assert pins and all(line.count("==") == 1 and "@" not in line for line in pins)
    assert pins == sorted(set(pins))


def test_every_dependency_is_pinned():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    pinned = set(re.findall(r"^([\w-]+)==", (ROOT / "constraints.txt").read_text(), re.MULTILINE))
    required = chain(project["dependencies"], *project["optional-dependencies"].values())
    names = {re.match(r"[\w-]+", requirement)[0].lower() for requirement in required}
    assert names <= pinned
