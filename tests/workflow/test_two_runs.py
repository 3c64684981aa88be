"""Two runs at once, and what a killed one leaves: seen by Snakemake itself."""

import signal
import time

from tests.workflow.conftest import TABLE, trimmed_paper


def test_a_live_run_keeps_its_locks_and_its_results_and_a_dead_one_does_not(
    paper, tmp_path_factory
):
    into = tmp_path_factory.mktemp("into")
    other = trimmed_paper(tmp_path_factory.mktemp("other"))
    target = [f"{into}/{TABLE}", "--config", f"into={into}", "trials=300"]

    def left():
        places = (paper.folder / ".snakemake/locks", paper.folder / ".snakemake/runs")
        return {
            file.name for place in (*places, into / "results/.runs") for file in place.glob("*")
        }

    run = paper.start("-j1", *target)
    while not {"0.input.lock", "0.output.lock"} <= left():
        assert run.poll() is None, run.communicate()
        time.sleep(0.05)
    held = left()
    refused = other.snakemake(*target, fails=True).splitlines()[-1]
    assert refused.startswith(f"error: {into}/results: a run in {paper.folder} on host ")
    assert f"process {run.pid}, writes there" in refused and ": rm " in refused
    for project in (paper, other):
        project.snakemake("-n", *target)
        assert left() == held
    run.send_signal(signal.SIGKILL)
    run.communicate()
    paper.snakemake("-n", *target)
    assert left() == held
    output = paper.snakemake(*target)
    assert left() == set() and "About" in output and "of memory" in output


def test_trials_that_do_not_fit_are_refused_at_the_start(paper):
    line = paper.snakemake(TABLE, "--config", f"trials={10**9}", fails=True).splitlines()[-1]
    assert line.startswith("error: results: the results take about ") and " GB are free" in line
    assert not list(paper.folder.glob("results/logs/**/*.mcap"))
