"""Tails, convergence and mismatch against known answers, and the points that are for them."""

from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest

from repro.errors import ReproError
from repro.layout import Layout
from repro.parameters.families import Resolved
from repro.parameters.load import whose_logs
from repro.parameters.point_names import batch_of, is_common, is_plain, is_reading
from repro.parameters.settings import checked_settings
from repro.plot.convergence import convergence
from repro.plot.mismatch import mismatch
from repro.runner import run
from repro.studies.rss_2d import STUDY as RSS_2D
from repro.tables.convergence import Convergence, where
from repro.tables.mismatch import mean_transmission
from repro.tables.tails import entries, worst_share
from repro.verdicts.decidable import write_decidable
from repro.workflow.registry import Registry, swept_filters
from tests.conftest import points, small_log


def test_the_rate_of_a_known_error_of_one_over_the_particles():
    random, counts = np.random.default_rng(3), np.array([25, 50, 100, 200, 500])
    scale = 1.0 / counts + 1.0 / 1000  # of the distance of two estimates
    squared = scale * random.chisquare(5, (4000, 1)) * random.chisquare(3, (4000, len(counts)))
    rate, error = Convergence(counts, 1000, squared).rate()
    assert abs(rate - 1.0) < 3 * error < 0.1
    half = Convergence(counts, 1000, np.sqrt(scale) * np.ones((10, 1)))
    assert half.rate()[0] == pytest.approx(0.5)
    assert half.beyond(100).particles.tolist() == [100, 200, 500]


def test_the_tail_of_a_known_distribution():
    trials = 20_000
    errors = (1.0 - np.random.default_rng(5).uniform(size=trials)) ** (-1 / 3)  # Pareto of index 3
    found = {name: (value, mcse) for name, value, mcse in entries(errors, errors > 4.0)}
    exact = {
        "lost": 4.0**-3,
        "mean": 1.5,
        "mean_not_lost": 1.5 * (1 - 4.0**-2) / (1 - 4.0**-3),
        "q05": 0.95 ** (-1 / 3),
        "q50": 0.5 ** (-1 / 3),
        "q95": 0.05 ** (-1 / 3),
        "q99": 0.01 ** (-1 / 3),
        "worst_share": 0.05 ** (2 / 3),
    }
    for name, value in exact.items():
        assert abs(found[name][0] - value) < 4 * found[name][1] < 0.3 * value, name


def test_the_error_of_the_worst_share_is_that_of_repeated_samples():
    random = np.random.default_rng(7)
    shares = [worst_share(np.sort(random.lognormal(size=400))) for _ in range(300)]
    values, errors = np.transpose(shares)
    assert np.mean(errors) == pytest.approx(np.std(values), rel=0.2)


def test_a_wrong_value_changes_the_model_of_the_filter_and_nothing_where_it_is_right():
    log = small_log("linear_losses", "loss=0.5", trials=20, steps=40)
    (_, right), (_, same), (_, wrong) = (
        run(log, "bkf_2", {"prior": "theta"} | assumed)
        for assumed in (
            {},
            {"assumed_loss_probability": 0.5},
            {"assumed_loss_probability": 0.05},
        )
    )
    np.testing.assert_array_equal(right.error, same.error)
    squared = [(runs.error**2).sum(axis=-1).mean() for runs in (right, wrong)]
    assert squared[1] > 1.05 * squared[0]


def test_a_wrong_value_is_checked_like_a_right_one():
    log = small_log("linear_losses", "loss=0.5")
    with pytest.raises(ReproError, match=r"bkf_1.*loss_probability.*at most 1"):
        run(log, "bkf_1", {"assumed_loss_probability": 1.5})
    kept = checked_settings("bkf_2", {"prior": "theta", "assumed_loss_probability": 0.1}, "here")
    assert kept == {"prior": "theta", "assumed_loss_probability": 0.1}


def test_a_harvest_of_one_unit_gives_its_probability_to_transmission():
    true = points()["rss_2d"]["base"].parameters
    certain = RSS_2D.Parameters.checked(
        true.plain() | {"harvest_transition": [[0.2, 0.8], [0.2, 0.8]]}, "test"
    )
    assert mean_transmission(certain) == pytest.approx(0.8)


NAMES = ["base", "convergence-particles=5", "mismatch-p=1", "reading-x", "sensitivity-x"]


def test_points_of_tables_of_their_own_are_in_no_other():
    assert [p for p in NAMES if is_plain(p)] == ["base"]
    assert [p for p in NAMES if is_common(p)] == ["base", "reading-x"]
    assert [p for p in NAMES if is_reading(p)] == ["reading-x", "sensitivity-x"]
    assert [*map(batch_of, NAMES)] == ["main", "convergence", "mismatch", "readings", "requested"]
    parameters = SimpleNamespace(plain=dict)
    logs = whose_logs({p: SimpleNamespace(parameters=parameters) for p in reversed(NAMES)})
    assert set(logs.values()) == {"base"} or logs["convergence-particles=5"] == "reading-x"
    assert logs["reading-x"] not in NAMES[1:3]


def test_a_filter_runs_on_such_a_point_if_its_settings_are_swept():
    swept = {"mapf.particles, mpf.particles": 5}
    named = {p: Resolved(p, {}, {}, "", swept if "conv" in p else {}) for p in NAMES[:2]}
    registry = Registry(Layout("results"), {"deadband": named}, 1)
    for name in ("mapf", "mapf_nc"):
        registry.runs(name, ["deadband"])
    assert registry.catalogue("deadband") == {"deadband": {"base": ["mapf", "mapf_nc"]}}
    assert registry.catalogue("deadband", table="convergence") == {
        "deadband": {"base": ["mapf", "mapf_nc"], NAMES[1]: ["mapf"]}
    }
    assert swept_filters(swept) == {"mapf", "mpf"}
    assert where("convergence-layout=square40-particles=25") == "layout=square40"
    assert [where(p) for p in ("convergence-particles=5", "particles=20-loss=0.1")] == [
        "base",
        "loss=0.1",
    ]


def test_a_margin_falls_with_the_root_of_the_runs(tmp_path):
    parts = [("a", -8.0), ("a", -20.0), ("b", 40.0), ("b", -5.0), ("c", -float("inf"))]
    claims = pd.DataFrame(parts, columns=["item", "margin"]).assign(
        paper="p", statement="s", runs="radar:1600 ungm:100", verdict=["holds"] * 5
    )
    claims.loc[2, "verdict"] = "fails"
    claims.to_csv(tmp_path / "claims.csv", index=False)
    printed = {"radar": 100, "ungm": 100}
    write_decidable([tmp_path / "claims.csv"], printed, 3.0, tmp_path / "decidable.csv")
    found = pd.read_csv(tmp_path / "decidable.csv").set_index("item")
    assert found["margin_as_printed"].to_dict() == {"a": -2.0, "b": 10.0}  # a quarter
    assert found["verdict_as_printed"].to_dict() == {"a": "undecided", "b": "fails"}
    assert found.loc["a", "runs_needed"] == 225  # 1600 (3 / 8)^2


@pytest.mark.parametrize("assumed", [[0.1, 0.5, 0.9], ["Bernoulli", "Markov", "Markov"]])
def test_pictures_of_mismatch_and_convergence(assumed):
    rows = pd.DataFrame(
        {"study": "radar", "filter": "bkf_1", "parameter": "loss", "true": assumed[1]}
        | {"assumed": assumed, "relative": [1.2, 1.0, 1.1], "relative_mcse": 0.1}
        | {"relative_median": 1.0}
    )
    sizes = pd.DataFrame(
        {"study": "radar", "where": "loss=0.1", "filter": "rbpf", "particles": [10, 100, 1000]}
        | {"reference": 1000, "printed": 100, "error": [3.0, 2.0, 1.0], "mcse": 0.1}
        | {"squared_distance": [4.0, 1.0, 0.0], "squared_distance_mcse": 0.1, "rate": 1.0}
        | {"rate_mcse": 0.1, "rate_beyond": np.nan, "rate_beyond_mcse": np.nan}
    )
    results = SimpleNamespace(
        mismatch=lambda study: rows, convergence=lambda study: sizes, own_filters=[]
    )
    for drawn, lines in ((mismatch(results, ["radar"]), 1), (convergence(results, ["radar"]), 2)):
        assert len(drawn.axes) == lines
        assert all(axes.get_legend() or axes is not drawn.axes[0] for axes in drawn.axes)
