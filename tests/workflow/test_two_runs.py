"""Two runs at once, and what a killed one leaves: seen by Snakemake itself."""

import signal
import time

from tests.workflow.conftest import Project

TABLE = "results/tables/linear_delays.csv"


def test_a_live_run_keeps_its_locks_and_its_results_and_a_dead_one_does_not(
    trimmed, tmp_path_factory
):
    into = tmp_path_factory.mktemp("into")
    other = Project(tmp_path_factory.mktemp("other"))
    other.keep_only("packet_delays", "linear_delays", ["arrival=0.5", "arrival=0.9"])
    target = [f"{into}/{TABLE}", "--config", f"into={into}", "trials=300"]

    def left():
        places = (trimmed.folder / ".snakemake/locks", trimmed.folder / ".snakemake/runs")
        return {
            file.name for place in (*places, into / "results/.runs") for file in place.glob("*")
        }

    run = trimmed.start("-j1", *target)
    while not {"0.input.lock", "0.output.lock"} <= left():
        assert run.poll() is None, run.communicate()
        time.sleep(0.05)
    held = left()
    refused = other.snakemake(*target, fails=True).splitlines()[-1]
    assert refused.startswith(f"error: {into}/results: a run in {trimmed.folder} on host ")
    assert f"process {run.pid}, writes there" in refused and ": rm " in refused
    for project in (trimmed, other):
        project.snakemake("-n", *target)
        assert left() == held
    run.send_signal(signal.SIGKILL)
    run.communicate()
    trimmed.snakemake("-n", *target)
    assert left() == held
    output = trimmed.snakemake(*target)
    assert left() == set() and "About" in output and "of memory" in output


def test_trials_that_do_not_fit_are_refused_at_the_start(trimmed):
    line = trimmed.snakemake(TABLE, "--config", f"trials={10**9}", fails=True).splitlines()[-1]
    assert line.startswith("error: results: the results take about ") and " GB are free" in line
    assert not list(trimmed.folder.glob("results/logs/**/*.mcap"))
