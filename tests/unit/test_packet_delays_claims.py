"""The tests behind the claims of [packet_delays], each where it must hold and where it must not."""

from types import SimpleNamespace

import numpy as np
import pytest

from repro.logs import Log
from repro.papers.packet_delays import tables
from repro.papers.packet_delays.claims import errors, remarks, table_2, theorem_1, wsn_tracking
from repro.papers.packet_delays.points import LINEAR
from repro.runner import run
from repro.statistics import metrics
from repro.statistics.runs import Runs
from repro.verdicts.claims import overall
from repro.verdicts.published import read_published
from tests.conftest import ROOT, points, small_log

POINT, TRIALS = "arrival=0.5", 80
TOLERANCE = 3.0
RNG = np.random.default_rng(5)


class Linear:
    """Results of one point of the linear example in memory; `instead` runs in place of the OMVF."""

    catalogue = {LINEAR: {POINT: ["omvf", "sun"]}}  # noqa: RUF012

    def __init__(self, instead: str = "omvf"):
        self._instead = instead

    def log(self, study: str, point: str) -> Log:
        return small_log(study, point, TRIALS, steps=remarks.HORIZON)

    def runs(self, study: str, point: str, filter_: str) -> Runs:
        name = self._instead if filter_ == "omvf" else filter_
        settings = points()[study][point].filters.get(name, {})
        return run(self.log(study, point), name, settings)[1]

    def parameters(self, study: str, point: str):
        return points()[study][point].parameters

    def analysis(self, study: str):
        return SimpleNamespace(equal_within=1e-6, orthogonal_within=0.05)


def verdict(parts) -> str:
    return overall(part.verdict(TOLERANCE) for part in parts)


@pytest.mark.parametrize(("filter_", "expected"), [("omvf", "holds"), ("intermittent_kf", "fails")])
def test_a_filter_that_uses_the_arrivals_is_no_function_of_y_alone(filter_, expected):
    assert verdict(remarks.omvf_needs_no_arrivals(Linear(filter_))) == expected


def test_nahis_filter_on_another_channel_is_far_from_orthogonal_to_this_one():
    parts = theorem_1.omvf_error_orthogonal_to_received(Linear("nahi"))
    assert len(parts) == 12 and verdict(parts) == "fails"  # 3 lags, 2 components, 2 sides


def test_a_correlation_and_its_error():
    first, noise = RNG.normal(size=(2, 400, 25))
    value, error = theorem_1._correlation(first, 0.6 * first + 0.8 * noise)
    assert value == pytest.approx(0.6, abs=4 * error)
    assert error == pytest.approx((1 - 0.6**2) / np.sqrt(first.size), rel=0.2)


def test_remark_7_is_no_distribution():
    assert verdict(remarks.remark_7_weights_are_probabilities(Linear())) == "fails"


@pytest.fixture
def row(monkeypatch):
    """Puts SAEE in the place of the runs': a function of N and p, with noise of one standard."""

    def put(saee, deviation=0.1):
        def mean_error(results, bound, arrival):
            trial = np.random.default_rng(7).normal(size=300)  # common to all cells
            own = np.random.default_rng([bound, round(100 * float(arrival))]).normal(size=300)
            return saee(bound, float(arrival)) + deviation * (trial + own)

        monkeypatch.setattr(table_2, "mean_error", mean_error)
        monkeypatch.setattr(tables, "mean_error", mean_error)
        names = [f"n{n}-arrival={p}" for n in (0, 1, 2) for p in (0.8, 0.85, 0.9, 0.95, 0.99)]
        return SimpleNamespace(catalogue={"wsn_tracking": names})

    return put


@pytest.mark.parametrize(
    ("slope", "of_bound", "over_p", "over_n"),
    [
        (-9.0, -1.0, "holds", "holds"),
        (9.0, 1.0, "fails", "fails"),
        (0, 0, "undecided", "undecided"),
    ],
)
def test_the_order_of_table_2(row, slope, of_bound, over_p, over_n):
    results = row(lambda n, p: 10 + slope * p + of_bound * n)
    assert verdict(table_2.saee_falls_with_arrival_probability(results)) == over_p
    assert verdict(table_2.saee_falls_with_packet_bound(results)) == over_n
    useless = verdict(table_2.later_packets_are_useless(results))
    assert useless == {"holds": "fails", "fails": "holds"}.get(over_n, over_n)


def test_the_cells_of_table_2_are_published_and_have_the_errors_of_their_means(row):
    cells = tables.TABLES["Table 2"](row(lambda n, p: n + p))
    published = read_published(ROOT / "params/published/packet_delays.csv")["item"]
    assert set(cells.items) == {item for item in published if item.startswith("Table 2")}
    expected = 0.1 * np.sqrt(2 / 300)  # of a mean of 300 runs
    np.testing.assert_allclose(metrics.jackknife_error(cells.left_out), expected, rtol=0.2)


def test_errors_before_and_after_the_only_missed_packet(monkeypatch):
    missed = np.array([[0, 0, 1, 0], [0, 1, 1, 0], [1, 0, 0, 0]], dtype=bool)  # one run is left
    distance = np.array([9.0, 1.0, 2.0, 30.0, 40.0])  # at k = 0 ... 4; k = 0 does not count
    error = np.stack([np.tile(distance, (3, 1)), np.zeros((3, 5))], axis=-1)
    results = SimpleNamespace(
        runs=lambda *_: SimpleNamespace(error=error), each_log=lambda *_: missed
    )
    before, after = errors.largest_before_and_after_miss(results, 1, "0.98", "ekf")
    assert before.tolist() == [2.0] and after.tolist() == [40.0]


@pytest.mark.parametrize(("printed", "expected"), [(0.5, "holds"), (1.5, "fails"), (0.0, "fails")])
def test_a_printed_number_among_the_extremes_is_not_typical(printed, expected):
    parts = wsn_tracking._typical("x", printed, np.linspace(0, 1, 400), (0.05, 0.95))
    assert verdict(parts) == expected
