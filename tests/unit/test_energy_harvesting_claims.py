"""The comparisons behind the claims of [energy_harvesting], on made-up errors."""

import numpy as np
import pytest
from scipy import stats

from repro import plugins
from repro.network.energy_harvesting import lemma_1_matrix
from repro.papers.energy_harvesting.claims.comparisons import (
    log_ratio_within,
    no_more_lost,
)
from repro.papers.energy_harvesting.claims.remarks import of_exponentials, of_gaussians
from repro.simulate import simulated
from repro.statistics.shards import Columns
from repro.verdicts.claims import most, overall
from tests.conftest import points

RUNS = 200


def errors(scale):
    """Squared errors of every run and step; those of two scales are paired."""
    drawn = np.random.default_rng(3).normal(size=(RUNS, 20))
    return Columns(iter([(scale * drawn) ** 2]), [RUNS])


def verdict(parts):
    return overall(part.verdict(3) for part in parts)


@pytest.mark.parametrize(
    ("first", "second", "expected"),
    [(1.4, 1.0, "holds"), (1.0, 1.4, "holds"), (1.6, 1.0, "fails"), (1.0, 1.6, "fails")],
)
def test_errors_approach_within_a_factor_on_both_sides(first, second, expected):
    assert verdict(log_ratio_within("", [errors(first), errors(second)], 1.5)) == expected


def test_a_single_run_says_nothing_about_a_ratio():
    of_one = [errors(1.0).only(np.arange(RUNS) == 0)] * 2
    assert verdict(log_ratio_within("", of_one, 1.5)) == "undecided"


@pytest.mark.parametrize(("lost", "expected"), [(0, "holds"), (40, "fails"), (10, "undecided")])
def test_a_filter_that_loses_more_runs_is_not_the_more_accurate(lost, expected):
    losses = np.arange(RUNS) < lost, np.zeros(RUNS, dtype=bool)
    assert verdict([no_more_lost("", losses, 0.05)]) == expected


@pytest.mark.parametrize(("bad", "expected"), [(0, "holds"), (40, "fails"), (20, "undecided")])
def test_a_filter_tracks_in_more_than_a_share_of_the_runs(bad, expected):
    assert verdict([most("", np.arange(RUNS) >= bad, 0.9)]) == expected


def test_matrix_of_lemma_1_by_hand():
    # Ebar = 3, H uniform on {0, 1}: columns 0 and 1 are equal, as no unit is left of either
    wanted = [[0.5, 0.5, 0, 0], [0.5, 0.5, 0.5, 0], [0, 0, 0.5, 0.5], [-1, -1, -1, -0.5]]
    np.testing.assert_array_equal(lemma_1_matrix(np.array([0.5, 0.5, 0.0]), 3), wanted)


def test_the_quadrature_of_both_noises_is_their_known_density():
    _, found = of_exponentials(2.0, 0.0)
    np.testing.assert_allclose(found, stats.gamma(2, scale=2.0).pdf(np.linspace(0, 20, 41)[1:]))
    _, found = of_gaussians(0.1, 0.001)
    known = stats.norm(scale=np.sqrt(0.101)).pdf(np.linspace(-1, 1, 41) * 10 * np.sqrt(0.1))
    np.testing.assert_allclose(found, known, rtol=1e-6, atol=1e-15)


@pytest.mark.parametrize("study", ["ungm", "rss_2d", "rss_3d"])
def test_truth_starts_where_printed_or_by_the_prior(study):
    parameters = points()[study]["base"].parameters
    for initial_truth, deviation in (
        ("printed", 0.0),
        ("drawn", {"ungm": 2.0, "rss_2d": 25.0, "rss_3d": 10.0}[study]),
    ):
        changed = parameters.model_copy(update={"initial_truth": initial_truth, "steps": 1})
        log = simulated(study, "base", changed, 1, np.arange(400))
        first = log.values["/truth"][:, 0, 0]
        printed = np.atleast_1d(plugins.study(study).model(changed).initial_mean)[0]
        assert first.std() == pytest.approx(deviation, rel=0.15)
        assert first.mean() == pytest.approx(printed, abs=4 * deviation / 20 + 1e-12)
