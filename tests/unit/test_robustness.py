"""Verdicts under other readings, from runs of which the order is known."""

from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from repro.layout import Layout
from repro.parameters.point_names import batch_of
from repro.statistics.runs import Runs, RunsWriter
from repro.tables.results import Results
from repro.tables.under_reading import NotRunError, UnderReading
from repro.verdicts import robustness
from repro.verdicts.claims import Claim, below, smaller
from repro.verdicts.published import COLUMNS
from repro.verdicts.robustness import judge
from repro.verdicts.standing import standing

STUDY, TRIALS = "deadband", {"base": 60, "far": 60, "reading-a": 40, "reading-b@far": 30}
# Sizes of the errors: under the reading a the order of the filters is the other one.
SIZE = {
    "base": {"mapf": 1.0, "mpf": 2.0},
    "far": {"mapf": 1.0, "mpf": 2.0},
    "reading-a": {"mapf": 2.0, "mpf": 1.0},
    "reading-b@far": {"mapf": 1.0},
}
READINGS = {
    STUDY: {
        "reading-a": {"points": {"base": "reading-a"}, "changes": {"speed": 2}},
        "reading-b": {"points": {"far": "reading-b@far"}, "changes": {"mapf.particles": 9}},
    }
}


@pytest.fixture
def results(tmp_path):
    rng = np.random.default_rng(0)
    batches: dict[tuple[str, str], list[str]] = {}
    for point, sizes in SIZE.items():
        for filter_ in sizes:
            batches.setdefault((batch_of(point), filter_), []).append(point)
    for (batch, filter_), points in batches.items():
        file = Path(Layout(tmp_path).run(STUDY, batch, filter_, 0))
        file.parent.mkdir(parents=True)
        with file.open("wb") as stream, RunsWriter(stream) as writer:
            for point in points:
                error = np.full((TRIALS[point], 3, 2), SIZE[point][filter_])
                error *= rng.uniform(0.9, 1.1, (TRIALS[point], 1, 1))
                writer.add(point, Runs(error, None, np.zeros(len(error)), recorded={}))
    table = Path(Layout(tmp_path).table(STUDY))
    table.parent.mkdir()
    rows = [
        {"study": STUDY, "point": point, "filter": filter_, "metric": "rmse", "component": "x"}
        | {"value": size, "mcse": 0.01, "trials": TRIALS[point]}
        for point, sizes in SIZE.items()
        for filter_, size in sizes.items()
    ]
    pd.DataFrame(rows).to_csv(table, index=False)
    catalogue = {STUDY: {point: [*sizes] for point, sizes in SIZE.items()}}
    return Results(tmp_path, catalogue, 1, {}, [], tolerance=3.0)


def size(results, point, filter_):
    return results.each(STUDY, point, filter_, lambda runs: np.abs(runs.error).mean(axis=(1, 2)))


def compared(point):
    return lambda results: [
        smaller("mapf - mpf", size(results, point, "mapf"), size(results, point, "mpf"))
    ]


def of_far_points(results):
    points = [point for point in results.catalogue[STUDY] if point == "far"]
    return [smaller("", size(results, point, "mapf"), np.array([1.5])) for point in points]


def of_every_point(results):
    """Of all points there are, the first against a bound; nothing if there is none."""
    first, *_ = results.catalogue[STUDY]
    return [smaller("mapf - 1.5", size(results, first, "mapf"), np.array([1.5]))]


CLAIMS = [
    Claim("base-order", "", compared("base")),
    Claim("far-order", "", compared("far")),
    Claim("small", "", of_every_point),
    Claim("of-no-run", "", lambda results: [smaller("", np.zeros(2), np.ones(2))]),
    Claim("far-small", "", of_far_points),
]


@pytest.fixture
def judged(results, tmp_path, monkeypatch):
    """The verdicts under the readings, by item and reading."""
    monkeypatch.setattr(robustness, "import_module", lambda name: SimpleNamespace(CLAIMS=CLAIMS))
    value = dict.fromkeys(COLUMNS, "") | {"item": "T1", "study": STUDY, "point": "base"}
    value |= {"filter": "mapf", "metric": "rmse", "component": "x", "value": "1.0", "digits": "1"}
    value |= {"kind": "value", "class": "predicted", "trials": "60", "expect": "match"}
    pd.DataFrame([value], columns=COLUMNS).to_csv(tmp_path / "published.csv", index=False)
    judge(results, "paper", READINGS, tmp_path / "published.csv", tmp_path / "judged.csv")
    return pd.read_csv(tmp_path / "judged.csv").set_index(["item", "reading"])


def test_each_claim_and_value_is_judged_where_the_reading_is(judged):
    of_readings = judged.loc[judged.index.get_level_values("reading").notna()]
    assert of_readings["verdict"].to_dict() == {
        ("T1", "reading-a"): "differs",
        ("base-order", "reading-a"): "fails",
        ("far-order", "reading-a"): "not run",
        ("small", "reading-a"): "fails",
        ("far-small", "reading-a"): "not run",
        ("base-order", "reading-b"): "not run",
        ("far-order", "reading-b"): "not run",  # mpf does not run there
        ("small", "reading-b"): "holds",
        ("far-small", "reading-b"): "holds",
    }


def test_margin_trials_and_changes_are_those_of_the_reading(judged):
    row = judged.loc[("base-order", "reading-a")]
    assert (row["trials"], row["points"], row["changes"]) == (40, "base", "speed = 2")
    assert row["margin"] > 50
    assert judged.loc[("small", "reading-b"), "margin"] < -20


def test_what_asks_for_no_run_needs_no_reading(judged):
    (row,) = judged.loc[judged["verdict"] == "needs none"].reset_index().to_dict("records")
    assert (row["item"], row["changes"]) == ("of-no-run", "exact")
    assert standing("holds", pd.DataFrame([row])) == "needs none (exact)"


def test_a_claim_on_parameters_is_judged_where_a_reading_changes_it(results, tmp_path, monkeypatch):
    speed = {"base": 1.0, "far": 1.0, "reading-a": 2.0}
    monkeypatch.setattr(Results, "parameters", lambda self, study, point: speed[point])

    def slow(results):
        return [below("speed", results.parameters(STUDY, "base"), 1.5)]

    def positive(results):
        return [below("sign", -np.sign(results.parameters(STUDY, "base")), 0.0)]

    claims = SimpleNamespace(CLAIMS=[Claim("slow", "", slow), Claim("positive", "", positive)])
    monkeypatch.setattr(robustness, "import_module", lambda name: claims)
    pd.DataFrame(columns=COLUMNS).to_csv(tmp_path / "published.csv", index=False)
    judge(results, "paper", READINGS, tmp_path / "published.csv", tmp_path / "judged.csv")
    rows = pd.read_csv(tmp_path / "judged.csv").set_index("item")
    assert rows.loc[["slow"], "verdict"].tolist() == ["fails", "not run"]
    assert rows.loc["positive", "verdict"].tolist() == ["not run", "needs none"]


def test_a_reading_of_filter_settings_concerns_the_claims_on_these_filters(
    results, tmp_path, monkeypatch
):
    others = {STUDY: {"reading-a": READINGS[STUDY]["reading-a"] | {"changes": {"emvf.x": 1}}}}
    claims = SimpleNamespace(CLAIMS=CLAIMS[:1])
    monkeypatch.setattr(robustness, "import_module", lambda name: claims)
    pd.DataFrame(columns=COLUMNS).to_csv(tmp_path / "published.csv", index=False)
    judge(results, "paper", others, tmp_path / "published.csv", tmp_path / "judged.csv")
    assert pd.read_csv(tmp_path / "judged.csv").empty


def test_under_a_reading_only_what_is_read_so_is_there(results):
    view = UnderReading(results, {STUDY: {"far": "reading-b@far"}})
    assert list(view.catalogue[STUDY]) == ["far"] and view.filters(STUDY, "far") == ["mapf"]
    assert len(size(view, "far", "mapf")) == TRIALS["reading-b@far"]
    assert view.used == {(STUDY, "far", "mapf"): TRIALS["reading-b@far"]}
    assert view.table(STUDY)["point"].tolist() == ["far"]
    for point, filter_ in (("base", "mapf"), ("far", "mpf")):
        with pytest.raises(NotRunError):
            view.in_shards(STUDY, point, filter_)
    assert len(size(results, "far", "mapf")) == TRIALS["far"]  # the results stay as they are


def test_an_rmse_that_is_kept_for_the_next_claim_is_used_by_it_as_well(results):
    def squared(runs):
        return runs.error[:, :, 0] ** 2

    view = UnderReading(results, {STUDY: {"far": "reading-b@far"}})
    first = view.rmse(STUDY, "far", "mapf", squared, True)
    view.used.clear()
    assert view.rmse(STUDY, "far", "mapf", squared, True) is first
    assert view.used == {(STUDY, "far", "mapf"): TRIALS["reading-b@far"]}
    assert results.rmse(STUDY, "far", "mapf", squared, True).value != first.value


@pytest.mark.parametrize(
    ("verdict", "under", "stands"),
    [
        ("holds", ["holds", "holds", "not run"], "robust (2 readings)"),
        ("holds", ["holds", "undecided"], "conditional on b"),
        ("holds", ["holds", "few"], "robust (1 reading; too few trials in 1 more)"),
        ("holds", ["few"], "open (too few trials in 1 reading)"),
        ("holds", ["undecided", "fails"], "reversed under b"),
        ("undecided", ["undecided", "fails"], "conditional on b"),
        ("match", ["match", "differs"], "reversed under b"),
        ("match", ["differs"] * 6, "reversed under a, b, c, d and 2 more"),
        ("match", ["not run"], ""),
        ("match", [], ""),
    ],
)
def test_standing(verdict, under, stands):
    names = [f"reading-{n}" for n in "abcdef"[: len(under)]]
    readings = pd.DataFrame({"reading": names, "verdict": under, "margin": 1.0})
    few = readings["verdict"] == "few"  # undecided, but on the side of the claim
    readings.loc[few, ["verdict", "margin"]] = ["undecided", -1.0]
    assert standing(verdict, readings) == stands
