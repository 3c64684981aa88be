"""Weights and resampling in kernels against their definitions."""

import numpy as np
import pytest
from scipy.special import softmax

from repro.kernels import random, resampling
from repro.streams import Streams

RNG = np.random.default_rng(0)
ROW = np.array([0.1, 0.0, 0.25, 0.65])


def parents_of(weights, points):
    """Where points on (0, 1) fall among the cumulative weights."""
    return np.searchsorted(np.cumsum(weights)[:-1], points, side="right")


def systematic(weights, uniform):
    parents = np.empty(weights.size, dtype=np.int64)
    resampling.systematic(weights, uniform, parents)
    return parents


def multinomial(weights, uniforms):
    parents = np.empty(weights.size, dtype=np.int64)
    resampling.multinomial(weights, uniforms, np.empty(weights.size), parents)
    return parents


def uniforms_of(key, count):
    uniforms = np.empty(random.padded(count + 1))
    random.fill_uniforms(key, 1, random.RESAMPLING, uniforms)
    return uniforms


@pytest.mark.parametrize("count", [1, 2, 7, 200])
def test_systematic_gives_floor_or_ceiling(count):
    for row in softmax(3 * RNG.standard_normal((50, count)), axis=1):
        uniform = RNG.random()
        parents = systematic(row, uniform)
        np.testing.assert_array_equal(
            parents, parents_of(row, (np.arange(count) + uniform) / count)
        )
        children = np.bincount(parents, minlength=count)
        assert np.all(np.abs(children - count * row) < 1)
        assert np.all(np.diff(parents) >= 0)


def test_systematic_is_unbiased():
    chosen = np.concatenate([systematic(ROW, uniform) for uniform in RNG.random(20_000)])
    share = np.bincount(chosen, minlength=4) / chosen.size
    np.testing.assert_allclose(share, ROW, atol=0.01)
    assert share[1] == 0


@pytest.mark.parametrize("count", [1, 2, 7, 200])
def test_multinomial_gives_each_point_to_its_parent(count):
    for row in softmax(3 * RNG.standard_normal((50, count)), axis=1):
        uniforms = RNG.random(count + 1)
        gaps = -np.log(uniforms)
        points = np.cumsum(gaps)[:-1] / gaps.sum()  # sorted uniforms
        np.testing.assert_array_equal(multinomial(row, uniforms), parents_of(row, points))


@pytest.mark.parametrize("row", [ROW, np.full(4, 0.25)])
def test_children_are_multinomial(row):
    keys = Streams(3, "resampling", "filter:test", range(20_000)).keys()
    parents = np.stack([multinomial(row, uniforms_of(key, 4)) for key in keys])
    assert np.all(np.diff(parents, axis=1) >= 0)
    children = np.stack([(parents == i).sum(axis=1) for i in range(4)], axis=1)
    error = np.sqrt(4 * row * (1 - row) / len(keys))
    assert np.all(np.abs(children.mean(axis=0) - 4 * row) <= 4.5 * error)
    np.testing.assert_allclose(children.var(axis=0), 4 * row * (1 - row), atol=0.03)
    covariance = np.cov(children[:, 2], children[:, 3])[0, 1]
    assert covariance == pytest.approx(-4 * row[2] * row[3], abs=0.03)


@pytest.mark.parametrize("count", [1, 6, 200])
def test_logarithms_are_normalised(count):
    for row in 300 * RNG.standard_normal((20, count)) - 1e6:  # all underflow
        row[1:2] = -np.inf
        wanted = softmax(row)
        assert not resampling.normalise_logarithms(row)
        np.testing.assert_allclose(row, wanted, rtol=1e-12, atol=1e-300)
    sizes = np.empty(1)
    resampling.effective_sample_sizes(row[None], sizes)
    np.testing.assert_allclose(sizes, 1 / (row**2).sum(), rtol=1e-12)
    for bad in (-np.inf, np.inf, np.nan):
        row = np.full(count, -np.inf) if bad < 0 else RNG.standard_normal(count)
        row[-1] = bad
        assert resampling.normalise_logarithms(row)
        np.testing.assert_array_equal(row, 1 / count)


@pytest.mark.parametrize("bad", [np.zeros(5), np.full(5, np.nan), np.array([np.inf, 1, 1, 1, 1])])
def test_weights_without_a_positive_finite_sum_become_equal(bad):
    row = bad.copy()
    assert resampling.normalise(row)
    np.testing.assert_array_equal(row, np.full(5, 1 / 5))
    row = np.array([1.0, 3.0])
    assert not resampling.normalise(row)
    np.testing.assert_array_equal(row, [0.25, 0.75])
