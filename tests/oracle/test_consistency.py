"""Whether the statistics of consistency know a true covariance from a wrong one."""

import numpy as np
import pytest
from scipy import stats

from repro.filters.families.clouds import weighted_covariance
from repro.kernels import chi_square
from repro.runner import run
from repro.runner.consistency import judged_claims
from repro.statistics.consistency import claimed, normalised, ratio_of
from repro.tables.consistency import Expected, bounds, chi_square_bounds, verdict
from tests.conftest import catalogue, settings, small_log

COVARIANCE = np.array([[2.0, 0.6], [0.6, 0.5]])


@pytest.mark.parametrize("freedom", [1, 2, 3.7, 60, 9000])
def test_chi_square_against_scipy(freedom):
    for probability in (0.00135, 0.5, 0.95, 0.99865):
        expected = stats.chi2.ppf(probability, freedom)
        assert chi_square.quantile(probability, float(freedom)) == pytest.approx(expected, rel=1e-9)
    assert chi_square.probability_below(0.8 * freedom, float(freedom)) == pytest.approx(
        stats.chi2.cdf(0.8 * freedom, freedom), rel=1e-9
    )


@pytest.mark.parametrize(
    ("share", "expected"), [(1.0, "consistent"), (0.8, "overconfident"), (1.25, "cautious")]
)
def test_a_mistuned_covariance_has_the_known_ratio(share, expected):
    """Errors of a known covariance, of which a filter claims a share: NEES is its inverse."""
    errors = np.random.default_rng(1).multivariate_normal(np.zeros(2), COVARIANCE, (400, 30))
    claims = {"state": np.broadcast_to(share * COVARIANCE, (400, 30, 2, 2))}
    found = judged_claims(errors, {"state": (0, 1)}, claims)
    np.testing.assert_allclose(found[claimed("state")], share * 2.5)
    nees = found[normalised("state")]
    direct = (errors * np.linalg.solve(share * COVARIANCE, errors[..., None])[..., 0]).sum(-1) / 2
    np.testing.assert_allclose(nees, direct)
    mean = ratio_of(nees.sum(axis=1), np.full(400, 30.0))
    assert abs(mean.value - 1 / share) < 4 * mean.mcse
    limits = bounds(mean, Expected(1.0, 2), 3.0)
    assert verdict(float(mean.value), *limits, Expected(1.0, 2)) == expected
    for_a_step = chi_square_bounds(400 * 2, 3.0)
    inside = (nees.mean(axis=0) > for_a_step[0]) & (nees.mean(axis=0) < for_a_step[1])
    assert inside.mean() > 0.9 if share == 1.0 else inside.mean() < 0.5


def test_a_direction_without_variance_makes_an_error_infinite():
    flat = np.array([[1.0, 1.0], [1.0, 1.0]])
    errors = np.array([[[2.0, 2.0], [2.0, 1.0]]])
    found = judged_claims(errors, {"state": (0, 1)}, {"state": np.tile(flat, (1, 2, 1, 1))})
    np.testing.assert_array_equal(found[normalised("state")], [[2.0, np.inf]])


def test_covariance_of_weighted_particles():
    drawn = np.random.default_rng(2)
    particles, weights = drawn.normal(size=(1, 3, 50)), drawn.dirichlet(np.ones(50), 1)
    mean = (particles * weights[:, None]).sum(axis=-1)
    expected = np.cov(particles[0, [2, 0]], aweights=weights[0], bias=True)
    found = weighted_covariance(particles, weights, mean, (2, 0))
    np.testing.assert_allclose(found[0], expected)


@pytest.mark.parametrize("study", ["linear_losses", "linear_delays"])
def test_covariances_have_the_claimed_variances(study):
    """Of every filter; asking for them changes nothing else."""
    for point in ("short-loss=0.3", "loss=0.5", "arrival=0.7"):
        for name in catalogue()[study].get(point, []):
            log, given = small_log(study, point), settings(study, point, name)
            estimate, runs = run(log, name, given, consistency=True)
            np.testing.assert_array_equal(estimate, run(log, name, given)[0])
            if runs.claimed is not None:
                expected = np.broadcast_to(runs.claimed.sum(axis=-1), estimate.shape[:2])
                np.testing.assert_allclose(runs.recorded[claimed("state")], expected, rtol=1e-12)


def test_a_kalman_filter_is_consistent():
    """Without losses the innovations and errors of the Kalman filter are chi-square."""
    log = small_log("linear_losses", "no-loss", trials=400, steps=20)
    _, runs = run(log, "iekf", {}, consistency=True)
    for values, freedom in ((runs.recorded[normalised("state")], 2), (nis(runs), 1)):
        at_end = values[:, -1] * freedom
        assert stats.kstest(at_end, stats.chi2(freedom).cdf).pvalue > 1e-4
        low, high = chi_square_bounds(400 * freedom, 4.0)
        assert low < values[:, -1].mean() < high


def nis(runs):
    return runs.recorded["normalised innovation"]
