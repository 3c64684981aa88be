"""The leaderboard: its page, its picture, and the CPU time of the filters."""

from pathlib import Path

import pandas as pd
import pytest

from repro.layout import Layout
from repro.pages.leaderboard import summarised, write_leaderboard
from repro.parameters.load import load_paper
from repro.plot.leaderboard import leaderboard
from repro.tables.results import Results
from repro.workflow.job import job
from repro.workflow.timings import filter_times
from tests.conftest import ROOT

STUDY, POINTS = "radar", ("loss=0.1", "loss=0.3")
ERRORS = {"iekf": (1.0, 4.0), "bkf_1": (2.0, 8.0), "prior": (0.0, 0.0)}


@pytest.fixture
def ranking(tmp_path):
    """The file of a ranking in which one filter has no error, and none has lost a run."""
    rows = [
        {"study": STUDY, "family": "loss={loss_probability}", "point": point, "filter": filter_}
        | {"whose": "reference", "error": errors[i], "mcse": 0.1, "median": errors[i]}
        | {"trials": 9, "lost": float("nan")}
        | {"relative_to_informed": errors[i] / ERRORS["iekf"][i]}
        | {"relative_to_nothing": float("nan"), "best_of_paper": "bkf_1", "verdict": "worse"}
        for filter_, errors in ERRORS.items()
        for i, point in enumerate(POINTS)
    ]
    path = tmp_path / "table.csv"
    pd.DataFrame(rows).to_csv(path, index=False)
    return str(path)


def test_means_are_geometric_and_the_best_is_first(ranking):
    summary = summarised(pd.read_csv(ranking)).set_index("filter")
    assert list(summary.index) == ["prior", "iekf", "bkf_1"]
    assert summary["error"].tolist() == pytest.approx([0.0, 2.0, 4.0])
    assert summary["of informed"].tolist() == pytest.approx([0.0, 1.0, 2.0])


def test_the_page_has_no_empty_column_and_the_csv_no_cpu_time(ranking, tmp_path):
    times = pd.DataFrame(
        [(STUDY, "loss={loss_probability}", POINTS[0], "bkf_1", 12.345)],
        columns=["study", "family", "point", "filter", "cpu_us_per_step"],
    )
    csv, page = str(tmp_path / "board.csv"), tmp_path / "board.md"
    write_leaderboard({STUDY: ranking}, csv, str(page), times)
    heads = next(line for line in page.read_text().splitlines() if line.startswith("|"))
    assert "CPU" in heads and "of no data" not in heads and "lost" not in heads
    assert "12.3" in page.read_text() and "nan" not in page.read_text()
    assert "CPU" not in (tmp_path / "board.csv").read_text()


def test_the_picture_has_a_row_a_filter(ranking, tmp_path):
    described = load_paper(ROOT / "params/unknown_losses.yaml").described(STUDY)
    catalogue = {STUDY: {point: [*ERRORS] for point in POINTS}}
    results = Results(tmp_path, catalogue, 1, {STUDY: described}, [], 3.0)
    write_leaderboard({STUDY: ranking}, results.layout.page("leaderboard.csv"), tmp_path / "b.md")
    (axes,) = leaderboard(results).axes
    assert len(axes.get_yticklabels()) == len(ERRORS)


def test_cpu_time_is_a_trials_and_steps(tmp_path):
    points = {STUDY: {p: {"family": "f", "trials": 10, "steps": 50} for p in POINTS}}
    results = Results(tmp_path, {STUDY: {p: ["iekf"] for p in POINTS}}, 2, {}, [], 3.0)
    for shard in ("0", "1"):
        log = Path(Layout(tmp_path).job_log("iekf", STUDY, "main", shard))
        log.parent.mkdir(parents=True, exist_ok=True)
        with job(log) as usage:
            usage.of_points = {POINTS[0]: 0.25}  # the other point has not run
    times = filter_times(tmp_path, results.catalogue, points, 2)
    assert times["cpu_us_per_step"].tolist() == pytest.approx([1000.0])
