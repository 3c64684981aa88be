"""What the claims, facts and joint tests of censored_network compute."""

from types import SimpleNamespace

import numpy as np
import pytest

from repro.papers.censored_network import facts, tables
from repro.papers.censored_network.claims import limits, orders, ratios
from repro.papers.censored_network.convergence import Convergence, convergence
from repro.papers.censored_network.time_averages import root_over_steps, time_average
from repro.parameters.load import load_paper
from repro.runner import run
from repro.statistics.runs import Runs
from repro.statistics.shards import Columns
from repro.studies.deadband import STUDY
from repro.verdicts.claims import overall
from tests.conftest import ROOT, small_log


def analysis(study="deadband"):
    values = load_paper(ROOT / "params/censored_network.yaml").analysis[study]
    return STUDY.Analysis.checked(values, "test")


@pytest.mark.parametrize(
    ("filter_", "dead_band", "saturation"),
    [("mapf_nc", 1.152, 1.242), ("mapf_nmc", 1.608, 5.841), ("mpf", 1.018, 1.053)],
)
def test_ratios_of_the_published_averages(filter_, dead_band, saturation):
    assert ratios.published_ratio("deadband", filter_) == (dead_band, 300)
    assert ratios.published_ratio("saturation", filter_) == (saturation, 300)


def test_claims_on_the_limits_of_the_likelihood():
    results = SimpleNamespace(
        log=lambda study, point: small_log(study, point), analysis=lambda study: analysis()
    )
    for part in (*limits.no_censoring_limit(results), *limits.no_coupling_limit(results)):
        assert part.verdict(3.0) == "holds", part


class Filtered:
    """Errors by filter, of one study or of both alike; those of the base unless `point` says so."""

    tolerance = 3.0

    def __init__(self, errors, log=None):
        self._errors, self._log = errors, log

    def analysis(self, study):
        return analysis(study)

    def parameters(self, study, point):
        return self._log.parameters

    def log(self, study, point):
        return self._log

    def runs(self, study, point, filter_):
        return Runs(self._errors[filter_], None, np.zeros(len(self._errors[filter_])), {})

    def each(self, study, point, filter_, quantity):
        values = quantity(self.runs(study, point, filter_))
        return values if values.ndim == 1 else Columns(iter([values]), [len(values)])

    def in_shards(self, study, point, filter_):
        return SimpleNamespace(trials=len(self._errors[filter_]))


def errors(**scale):
    drawn = np.random.default_rng(3).standard_normal((200, 61, 9))
    other = np.random.default_rng(4).standard_normal((200, 61, 9))
    return {name: s * (drawn + 0.3 * other * (name == "mpf")) for name, s in scale.items()}


@pytest.mark.parametrize(("scale", "verdict"), [(1.0, "holds"), (1.3, "fails"), (1.1, "undecided")])
def test_close_is_decided_from_both_sides(scale, verdict):
    results = Filtered(errors(mapf=1.0, mpf=scale))
    found = overall(part.verdict(3.0) for part in ratios.mpf_close_to_mapf(results))
    assert found == verdict


def test_another_average_may_reverse_an_order():
    """Of a filter that is much worse at one step the root of the mean is the larger one."""
    of = errors(mapf=1.0, mapf_nc=0.9, mapf_nmc=2.0)
    of["mapf_nc"][:, 1] *= 8.0
    parts = orders.orders_under_other_averages(Filtered(of))
    verdicts = {part.name: part.verdict(3.0) for part in parts}
    assert verdicts["from k = 0: dead band, average: mapf - mapf_nc"] == "undecided"
    assert verdicts["root of the mean over k: dead band, average: mapf - mapf_nc"] == "holds"


def test_the_root_of_the_mean_weighs_the_large_errors():
    error = np.zeros((20, 4, 9))
    error[:, 1, 0], error[:, 2:, 0] = 3.0, 0.0
    results = Filtered({"mapf": error})
    assert time_average(results, "deadband", "mapf").value[0] == pytest.approx(1.0)
    root = time_average(results, "deadband", "mapf", average=root_over_steps)
    assert root.value[0] == pytest.approx(np.sqrt(3.0))


@pytest.mark.parametrize("rate", [0.5, 1.0])
def test_the_rate_of_convergence_and_its_error(rate):
    rng, sizes, of_reference = np.random.default_rng(5), np.array([100, 400, 1600]), 25600
    law = (1.0 / sizes + 1.0 / of_reference) ** rate
    found = [
        Convergence(sizes, of_reference, law * rng.chisquare(6, (30, 3)) / 6).rate()
        for _ in range(200)
    ]
    exponents, spread = np.transpose(found)
    assert exponents.mean() == pytest.approx(rate, abs=0.02)
    assert spread.mean() == pytest.approx(exponents.std(), rel=0.15)


def test_particle_filters_converge_at_the_stated_rate():
    log, settings = small_log("deadband", "base", trials=8, steps=4), {"resampling": "systematic"}
    sizes = {100: "particles=100", 400: "particles=400", 6400: "particles=6400"}
    runs = {
        (point, name): run(log, name, settings | {"particles": size})[1]
        for size, point in sizes.items()
        for name in ("mapf", "mpf")
    }
    results = SimpleNamespace(
        points=lambda study: {p: {"swept": {"mapf.particles": n}} for n, p in sizes.items()},
        runs=lambda study, point, filter_: runs[point, filter_],
    )
    for name in ("mapf", "mpf"):
        rate, error = convergence(results, "deadband", name).rate()
        assert abs(rate - 1.0) < 4 * error < 2.0
    sizes.clear()
    with pytest.raises(LookupError, match="no point sweeps"):
        convergence(results, "deadband", "mapf")


def test_zeros_that_pull_an_estimate_to_the_sensor():
    log = small_log("deadband", "base", trials=10, steps=80)
    offset = {"mapf": 0.0, "mapf_nmc": -0.5}
    truth = log.values["/truth"].reshape(10, 81, 3, 3)
    group = np.stack([log.field("/network", f"group_{i}") for i in "123"], axis=-1).astype(int)
    first = np.array(log.parameters.sensor_groups)[group - 1][..., 0, :]  # of each group
    error = np.zeros_like(truth)
    error[..., :2] = truth[..., :2] - first
    error = (error / np.linalg.norm(error, axis=-1, keepdims=True)).reshape(10, 81, 9)
    results = Filtered({name: by * error for name, by in offset.items()}, log)
    true, estimated, _ = facts.distances(results, "deadband", "mapf_nmc")
    np.testing.assert_allclose((estimated - true)[..., 0], -0.5)
    numbers = facts.zeros_at_face_value(results)
    assert numbers["zero_stands_for"] == pytest.approx(np.sqrt(10))
    assert numbers["zeros_pull_mapf"] == 0.0 and numbers["zeros_pull_mapf_nmc"] > 0.0
    # Without noise a zero comes from between 1 m and 10 m, and from farther than 3.2 m mostly.
    assert 70 < numbers["zeros_from_farther"] < 100 and 1 < numbers["zeros_share"] < 40


def test_the_cells_of_a_table_are_its_printed_values_but_the_averages():
    of = errors(mapf=1.0, mapf_nc=2.0, mapf_nmc=3.0, mpf=1.0)
    items, left_out = tables.TABLES["Table II"](Filtered(of))
    assert len(items) == 12 and left_out.shape == (200, 12)
    assert items[3] == "Table II: MAPF-NC target 1"
    average = time_average(Filtered(of), "saturation", "mapf_nc")
    np.testing.assert_array_equal(left_out[:, 3], average.left_out[:, 0])
