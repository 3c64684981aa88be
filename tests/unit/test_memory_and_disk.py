"""What a run will take, before it starts."""

from pathlib import Path

import pytest

from repro import plugins
from repro.errors import ReproError
from repro.inspect.interface import study
from repro.inspect.quick_ranking import quick_ranking
from repro.layout import Layout
from repro.logs import selected, write_log
from repro.runner import FilteredPoint, run_filter
from repro.workflow.memory_and_disk import (
    GB,
    MB,
    Free,
    Needs,
    _of_group,
    check_needs,
    estimated_needs,
    free,
)
from tests.conftest import points, small_log

STUDY, POINT = "wsn_tracking", "n2-arrival=0.9"
MUCH = Free(disk=100 * GB, memory=10 * GB)


def of(trials, outputs, root="elsewhere/results", shards=1, at_once=2):
    studies = {STUDY: {POINT: points()[STUDY][POINT].with_trials(trials)}}
    return estimated_needs(outputs, Layout(Path(root)), studies, shards, at_once)


def files(root="elsewhere/results", shard=0):
    layout = Layout(Path(root))
    return [layout.log(STUDY, POINT, shard), layout.run(STUDY, "main", "emvf", shard)]


def test_the_estimate_of_the_disk_is_near_what_is_written(tmp_path):
    log, runs = files(tmp_path)
    for file in (log, runs):
        Path(file).parent.mkdir(parents=True)
    steps = points()[STUDY][POINT].parameters.steps
    whole = small_log(STUDY, POINT, trials=50, steps=steps)
    write_log(log, selected(whole, plugins.study(STUDY).stored(whole.parameters)), 0.1)
    of_point = FilteredPoint(log, points()[STUDY][POINT].filters["emvf"])
    run_filter(STUDY, "emvf", {POINT: of_point}, runs)
    written = sum(Path(file).stat().st_size for file in (log, runs))
    assert of(50, files()).disk == pytest.approx(written, rel=0.3)
    # What is there is replaced.
    assert of(50, [log, runs], tmp_path).disk == pytest.approx(0, abs=0.3 * written)


def test_it_counts_the_files_that_will_be_made_and_their_shards():
    whole, half = of(1000, files()), of(1000, [*files(), *files(shard=1)], shards=2)
    assert half.disk == pytest.approx(whole.disk)
    assert half.memory < whole.memory < 1 * GB
    assert (whole.jobs, of(1000, files(), at_once=1).jobs) == (2, 1)
    assert of(1000, ["results/tables/x.csv", "figures/x.png"]) == Needs(0, 0, 0)


@pytest.mark.parametrize(
    ("trials", "there", "fault"),
    [
        (10**9, MUCH, "results: the results take about .* GB on disk and 100.0 GB are free: take"),
        (10**9, Free(1e30, 10 * GB), "2 jobs at once take about .* of memory and 10.0 GB are free"),
        (10**4, Free(5 * MB, 10 * GB), "5 MB are free: take fewer trials"),
    ],
)
def test_too_many_trials_are_refused_in_one_line(trials, there, fault):
    with pytest.raises(ReproError, match=fault) as error:
        check_needs(of(trials, files()), there, "results")
    assert "\n" not in str(error.value)


def test_the_line_at_the_start_names_what_is_needed_and_what_is_free():
    needed = Needs(disk=2 * GB, memory=200 * MB, jobs=2)
    assert check_needs(needed, MUCH, "results") == (
        "About 2.0 GB on disk (100.0 GB free), 0.4 GB of memory (10.0 GB free)."
    )
    # Jobs on other machines have their memory there.
    assert "0.2 GB of memory a job." in check_needs(
        needed, Free(100 * GB, 0), "results", local=False
    )


def test_what_is_free_is_bounded_by_the_container(tmp_path):
    assert free(tmp_path / "not/there").disk > 0 and free(tmp_path).memory > 0
    (tmp_path / "memory.current").write_text("100\n")
    for limit, left in (("300\n", 200), ("max\n", float("inf"))):
        (tmp_path / "memory.max").write_text(limit)
        assert _of_group(str(tmp_path)) == left
    assert _of_group("/nonexistent") == float("inf")


def test_trials_in_memory_are_refused_before_they_fill_it():
    for work in (
        lambda: study("radar").simulate("loss=0.1", trials=10**9),
        lambda: quick_ranking("radar", "loss=0.1", "ekf", {}, 1, 10**9, 3.0),
    ):
        with pytest.raises(ReproError, match=r"radar, loss=0\.1: 1000000000 trials of 100 steps"):
            work()
