"""Weights and resampling in kernels against those in NumPy."""

import numpy as np
import pytest

from repro.kernels import compiled_resampling, random, resampling
from repro.streams import Streams

RNG = np.random.default_rng(0)


def weights(rows, count):
    return resampling.normalised(3 * RNG.standard_normal((rows, count)))[0]


@pytest.mark.parametrize("count", [1, 2, 7, 200])
def test_systematic_is_numpys(count):
    for row, uniform in zip(weights(50, count), RNG.random(50), strict=True):
        parents = np.empty(count, dtype=np.int64)
        compiled_resampling.systematic(row, uniform, parents)
        np.testing.assert_array_equal(parents, resampling.systematic(row[None], uniform[None])[0])


def drawn(row, key):
    uniforms = np.empty(random.padded(row.size + 1))
    random.fill_uniforms(key, 1, random.RESAMPLING, uniforms)
    parents = np.empty(row.size, dtype=np.int64)
    compiled_resampling.multinomial(row, uniforms, parents)
    return parents


def test_multinomial_has_its_law():
    row = np.array([0.1, 0.0, 0.25, 0.65])
    keys = Streams(3, "resampling", "filter:test", range(20_000)).keys()
    parents = np.stack([drawn(row, key) for key in keys])
    assert (np.diff(parents, axis=1) >= 0).all()
    children = np.stack([(parents == i).sum(axis=1) for i in range(4)], axis=1)
    error = np.sqrt(4 * row * (1 - row) / len(keys))
    assert np.all(np.abs(children.mean(axis=0) - 4 * row) <= 4.5 * error)
    np.testing.assert_allclose(children.var(axis=0), 4 * row * (1 - row), atol=0.03)
    covariance = np.cov(children[:, 2], children[:, 3])[0, 1]
    assert covariance == pytest.approx(-4 * 0.25 * 0.65, abs=0.03)


@pytest.mark.parametrize("count", [1, 6, 200])
def test_normalised_as_numpys(count):
    logs = 300 * RNG.standard_normal((20, count)) - 1e6
    logs[0, 0] = -np.inf
    logs[1] = -np.inf
    logs[2, -1] = np.nan
    logs[3] = np.inf
    with np.errstate(invalid="ignore"):
        wanted, degenerate = resampling.normalised(logs)
    wanted[degenerate] = 1 / count
    for row, expected, bad in zip(logs, wanted, degenerate, strict=True):
        assert compiled_resampling.normalise_logarithms(row) == bad
        np.testing.assert_allclose(row, expected, rtol=1e-12, atol=1e-300)
    sizes = np.empty(20)
    compiled_resampling.effective_sample_sizes(logs, sizes)
    np.testing.assert_allclose(sizes, resampling.effective_sample_size(logs), rtol=1e-12)


@pytest.mark.parametrize("bad", [np.zeros(5), np.full(5, np.nan), np.array([np.inf, 1, 1, 1, 1])])
def test_weights_without_a_positive_finite_sum_become_equal(bad):
    row = bad.copy()
    assert compiled_resampling.normalise(row)
    np.testing.assert_array_equal(row, np.full(5, 1 / 5))
    row = np.array([1.0, 3.0])
    assert not compiled_resampling.normalise(row)
    np.testing.assert_array_equal(row, [0.25, 0.75])
