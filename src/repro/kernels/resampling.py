"""Weights and resampling of the particle filters, batched: (rows, particles)."""

import numpy as np


def normalised(log_weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Weights that sum to one along the last axis, and which rows are degenerate, (...,).

    The largest log weight is subtracted first, so that a row of very small weights keeps their
    order. A row without any finite log weight gets equal weights and is degenerate.
    """
    largest = log_weights.max(axis=-1, keepdims=True)
    degenerate = ~np.isfinite(largest)
    if degenerate.any():
        log_weights = np.where(degenerate, 0.0, log_weights)
        largest = np.where(degenerate, 0.0, largest)
    weights = log_weights - largest
    np.exp(weights, out=weights)
    weights /= weights.sum(axis=-1, keepdims=True)
    return weights, degenerate[..., 0]


def effective_sample_size(weights: np.ndarray) -> np.ndarray:
    """1 / sum of squared weights, along the last axis."""
    return 1.0 / np.vecdot(weights, weights)


def systematic(weights: np.ndarray, uniform: np.ndarray) -> np.ndarray:
    """Parents (rows, particles), ascending, by systematic resampling; one uniform per row.

    Up to particle i there are ceil(N c_i - u) children, c the cumulative weights. So the parent
    of child j is the number of particles with at most j children up to them: a count, then a sum.
    """
    rows, particles = weights.shape
    upto = np.cumsum(weights, axis=1)
    upto *= particles
    upto -= uniform[:, None]
    np.ceil(upto, out=upto)
    np.clip(upto, 0, particles, out=upto)
    upto[:, -1] = particles  # rounding must not lose the last child
    upto += (np.arange(rows) * (particles + 1))[:, None]
    ends = np.bincount(upto.astype(np.intp).ravel(), minlength=rows * (particles + 1))
    return np.cumsum(ends.reshape(rows, -1)[:, :-1], axis=1)


def multinomial(weights: np.ndarray, uniforms: np.ndarray) -> np.ndarray:
    """Parents (rows, particles), ascending, by multinomial resampling; one uniform per particle.

    Cumulative weights and uniforms are sorted together, as integer multiples of 2^-40, and a half
    is added to the uniforms to mark them: the number of weights before a uniform is its parent. A
    binary search would branch at random and cost several times as much.
    """
    rows, particles = weights.shape
    keys = np.empty((rows, 2 * particles))
    np.cumsum(weights, axis=1, out=keys[:, :particles])
    keys[:, particles - 1] = 1.0  # rounding must not leave a uniform without a parent
    keys[:, particles:] = uniforms
    keys *= 2.0**40
    np.floor(keys, out=keys)
    keys[:, particles:] += 0.5
    keys.sort(axis=1)
    parents = np.flatnonzero(keys != np.floor(keys)).reshape(rows, particles)
    parents -= np.arange(0, keys.size, 2 * particles)[:, None]
    parents -= np.arange(particles)
    return parents
