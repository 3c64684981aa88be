"""Results of other trials or another seed are refused, whoever has put them there."""

import shutil
import signal
import time

import psutil

from tests.torture.paper import smallest_paper

TABLE = "results/tables/linear_delays.csv"
# In its first run it waits for a file to appear, its log in memory, as a long filter would.
SLOW = """
import functools
import time
from pathlib import Path

begin = build


@functools.wraps(begin)
def build(model, settings):
    if not Path("free").exists():
        Path("held").touch()
        while not Path("go").exists():
            time.sleep(0.05)
    return begin(model, settings)
"""


def error_of(output):
    """The one line that a run has ended with."""
    (line,) = (line for line in output.splitlines() if line.strip().startswith("error: "))
    assert "Traceback" not in output
    return line


def of_trials(trials, into):
    return [f"{into}/{TABLE}", "--config", f"trials={trials}", f"into={into}"]


def wait_until(condition):
    """Wait at most a minute."""
    for _ in range(600):
        if condition():
            return
        time.sleep(0.1)
    raise AssertionError(f"a minute has passed: {condition}")


def test_neither_an_orphan_nor_lost_records_mix_two_runs(project, tmp_path_factory):
    into = tmp_path_factory.mktemp("into")
    project.keep_only("packet_delays", "linear_delays", ["arrival=0.5"])
    project.keep_filters("omvf", "nahi")
    with (project.folder / "src/repro/filters/nahi.py").open("a") as source:
        source.write(SLOW)
    run = project.start(*of_trials(6, into))
    wait_until((project.folder / "held").exists)
    left = psutil.Process(run.pid).children(recursive=True)
    run.send_signal(signal.SIGKILL)
    run.wait()  # its pipe is the orphan's too
    (project.folder / "free").touch()
    project.snakemake(*of_trials(4, into))
    expected = {file: file.read_bytes() for file in into.glob("results/[rtc]*/**/[!.]*.*")}
    assert expected
    (project.folder / "go").touch()  # the orphan ends with its six trials
    wait_until(lambda: not any(job.is_running() for job in left))
    assert {file: file.read_bytes() for file in into.glob("results/[rtc]*/**/[!.]*.*")} == expected
    assert "Nothing to be done" in project.snakemake(*of_trials(4, into))

    shutil.rmtree(project.folder / ".snakemake")
    output = project.snakemake("-n", *of_trials(3, into), fails=True)
    assert "trials 0 to 3, and trials 0 to 2 are asked for" in error_of(output)
    output = project.snakemake("-n", *of_trials(4, into), "root_seed=2", fails=True)
    assert "it was made with other parameters, seed or code than now" in error_of(output)


def test_runs_of_another_seed_are_refused_by_table_and_claims(tmp_path):
    """Put in behind the back of Snakemake, whose records are of the right ones."""
    project = smallest_paper(tmp_path)
    run = "results/runs/linear_delays/main/omvf/0.npz"
    targets = [TABLE, "results/claims/packet_delays.csv"]
    few = ("--config", "trials=4")
    project.snakemake(f"other/{run}", *few, "into=other", "root_seed=2")
    project.snakemake(*targets, *few)
    shutil.copy(project.folder / "other" / run, project.folder / run)
    output = project.snakemake("--keep-going", *targets, *few, fails=True)
    lines = [line.strip() for line in output.splitlines() if line.strip().startswith("error: ")]
    stale = f"error: {run}, arrival=0.5: stale: it was made with other parameters, seed or code"
    assert len(lines) == 2 and all(line.startswith(stale) for line in lines)
