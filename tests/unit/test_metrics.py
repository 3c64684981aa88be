import numpy as np
import pytest

from repro import metrics

VALUES = np.random.default_rng(5).gamma(2.0, size=(40, 3))


def test_jackknife_is_the_brute_force_one():
    statistic = metrics.root_mean(VALUES)
    left_out = np.array([np.sqrt(np.delete(VALUES, i, axis=0).mean(axis=0)) for i in range(40)])
    spread = ((left_out - left_out.mean(axis=0)) ** 2).sum(axis=0)
    np.testing.assert_allclose(statistic.mcse, np.sqrt(39 / 40 * spread))
    np.testing.assert_allclose(statistic.value, np.sqrt(VALUES.mean(axis=0)))


def test_standard_errors_cover_the_truth():
    """The mean of gamma(2) is 2: 3 standard errors hold it in all but a few of 400 samples."""
    samples = np.random.default_rng(6).gamma(2.0, size=(50, 400))
    for statistic, truth in (
        (metrics.mean(samples), 2.0),
        (metrics.root_mean(samples), np.sqrt(2)),
    ):
        missed = np.abs(statistic.value - truth) > 3 * statistic.mcse
        assert missed.mean() < 0.03


def test_one_trial_has_no_error():
    for statistic in (metrics.mean(VALUES[:1]), metrics.root_mean(VALUES[:1])):
        assert np.isnan(statistic.mcse).all()
        assert statistic.value == pytest.approx(statistic.median)
