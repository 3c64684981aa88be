"""The particle core: normals, weights, resampling, degenerate rows."""

import numpy as np
import pytest
from scipy.stats import kstest

from repro.filters.families import particle_filter
from repro.kernels import resampling
from repro.streams import Streams


def streams(trials, first=0):
    return Streams(3, "particles", "filter:test", range(first, first + trials))


def test_normals_are_standard_and_independent():
    drawn = particle_filter.standard_normal(streams(4), 2, 25001)  # an odd number of each row
    assert drawn.shape == (4, 2, 25001)
    assert kstest(drawn.ravel(), "norm").pvalue > 1e-3
    rows = drawn.reshape(8, -1)
    assert np.abs(np.corrcoef(rows) - np.eye(8)).max() < 4.5 / np.sqrt(25001)
    pairs = particle_filter.standard_normal(streams(1), 50000).reshape(2, -1)  # of one radius
    assert abs(np.corrcoef(*pairs**2)[0, 1]) < 4.5 / np.sqrt(25000)
    assert (rows**4).mean() == pytest.approx(3, abs=4 * np.sqrt(96 / rows.size))


def test_normals_of_a_trial_do_not_depend_on_the_batch():
    together = particle_filter.standard_normal(streams(3), 3, 7)
    alone = [particle_filter.standard_normal(streams(1, first=i), 3, 7) for i in range(3)]
    np.testing.assert_array_equal(together, np.concatenate(alone))


def test_systematic_resampling_gives_floor_or_ceiling():
    rng = np.random.default_rng(0)
    weights, _ = resampling.normalised(3 * rng.standard_normal((50, 200)))
    parents = resampling.systematic(weights, rng.random(50))
    for row, chosen in zip(weights, parents, strict=True):
        children = np.bincount(chosen, minlength=200)
        assert (np.abs(children - 200 * row) < 1).all()
        assert (np.diff(chosen) >= 0).all()


@pytest.mark.parametrize("scheme", ["systematic", "multinomial"])
def test_resampling_is_unbiased(scheme):
    weights = np.tile([[0.1, 0.0, 0.25, 0.65]], (20000, 1))
    parents = particle_filter.parents(weights, streams(20000), scheme)
    share = np.bincount(parents.ravel(), minlength=4) / parents.size
    np.testing.assert_allclose(share, weights[0], atol=0.01)
    assert share[1] == 0


def test_chosen_values_of_rows_with_and_without_components():
    rng = np.random.default_rng(1)
    clouds, chosen = rng.random((2, 3, 4, 5)), rng.integers(0, 5, (2, 3, 5))
    taken = particle_filter.taken(clouds, chosen)
    np.testing.assert_array_equal(taken, np.take_along_axis(clouds, chosen[:, :, None], axis=-1))
    np.testing.assert_array_equal(particle_filter.taken(clouds[:, :, 0], chosen), taken[:, :, 0])


def test_rows_that_nothing_explains_are_counted_and_weighted_equally():
    particles = np.arange(12.0).reshape(2, 1, 1, 6)
    before = particle_filter.equally_weighted(particles, streams(2))
    log_weights = np.full((2, 1, 6), -np.inf)
    log_weights[1] = -1e6 - np.arange(6)  # all underflow, and their order is kept
    after = particle_filter.weighted(particles, log_weights, before)
    np.testing.assert_array_equal(after.degenerate, [1, 0])
    np.testing.assert_allclose(after.weights[0], 1 / 6)
    assert after.weights[1, 0, 0] == pytest.approx(1 - np.exp(-1), rel=0.01)
    assert after.mean[0, 0, 0] == 2.5
    diagnostics = particle_filter.as_filter(None, None).diagnostics(after)
    assert diagnostics["effective_sample_size"][0] == pytest.approx(6)
