"""Weights and resampling of the filters in NumPy."""

import numpy as np
import pytest

from repro.kernels import resampling


def test_systematic_resampling_gives_floor_or_ceiling():
    rng = np.random.default_rng(0)
    weights, _ = resampling.normalised(3 * rng.standard_normal((50, 200)))
    parents = resampling.systematic(weights, rng.random(50))
    for row, chosen in zip(weights, parents, strict=True):
        children = np.bincount(chosen, minlength=200)
        assert (np.abs(children - 200 * row) < 1).all()
        assert (np.diff(chosen) >= 0).all()


@pytest.mark.parametrize("scheme", [resampling.systematic, resampling.multinomial])
def test_resampling_is_unbiased(scheme):
    weights = np.tile([[0.1, 0.0, 0.25, 0.65]], (20000, 1))
    shape = 20000 if scheme is resampling.systematic else (20000, 4)
    parents = scheme(weights, np.random.default_rng(3).random(shape))
    share = np.bincount(parents.ravel(), minlength=4) / parents.size
    np.testing.assert_allclose(share, weights[0], atol=0.01)
    assert share[1] == 0


def test_rows_that_nothing_explains_are_weighted_equally():
    log_weights = np.full((2, 6), -np.inf)
    log_weights[1] = -1e6 - np.arange(6)  # all underflow, and their order is kept
    weights, degenerate = resampling.normalised(log_weights)
    np.testing.assert_array_equal(degenerate, [True, False])
    np.testing.assert_allclose(weights[0], 1 / 6)
    assert weights[1, 0] == pytest.approx(1 - np.exp(-1), rel=0.01)
    effective = resampling.effective_sample_size(weights)
    assert effective[0] == pytest.approx(6) and 1 < effective[1] < 3
