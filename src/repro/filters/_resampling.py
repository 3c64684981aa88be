"""Weights and resampling for every filter with particles, batched: (trials, particles)."""

import numpy as np


def normalised(log_weights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Weights that sum to one along the last axis, and which rows were degenerate.

    The largest log weight is subtracted first, so that a row that underflows as a whole keeps its
    order. A row without any finite log weight gets equal weights and counts as degenerate.
    """
    largest = log_weights.max(axis=-1, keepdims=True)
    degenerate = ~np.isfinite(largest)
    weights = np.exp(log_weights - np.where(degenerate, 0.0, largest))
    weights = np.where(degenerate, 1.0, weights)
    weights /= weights.sum(axis=-1, keepdims=True)
    return weights, degenerate[..., 0]


def effective_sample_size(weights: np.ndarray) -> np.ndarray:
    """1 / sum of squared weights, along the last axis."""
    return 1.0 / np.vecdot(weights, weights)


def systematic(weights: np.ndarray, uniform: np.ndarray) -> np.ndarray:
    """Parents (rows, particles) by systematic resampling; one uniform a row.

    Up to particle i there are ceil(N c_i - u) children, c the cumulative weights: one pass.
    """
    rows, particles = weights.shape
    cumulative = np.cumsum(weights, axis=1)
    upto = np.ceil(particles * cumulative - uniform[:, None]).astype(np.intp)
    np.clip(upto, 0, particles, out=upto)
    upto[:, -1] = particles  # rounding must not lose the last child
    children = np.diff(upto, axis=1, prepend=0)
    parents = np.repeat(np.tile(np.arange(particles), rows), children.ravel())
    return parents.reshape(rows, particles)


def multinomial(weights: np.ndarray, uniforms: np.ndarray) -> np.ndarray:
    """Parents (rows, particles) by multinomial resampling; one uniform a particle."""
    rows, particles = weights.shape
    cumulative = np.cumsum(weights, axis=1)
    cumulative[:, -1] = 1.0
    # One search for all rows: row r occupies [r, r + 1).
    shift = np.arange(rows)[:, None]
    found = np.searchsorted((cumulative + shift).ravel(), (uniforms + shift).ravel(), side="right")
    parents = found.reshape(rows, particles) - shift * particles
    return np.minimum(parents, particles - 1)
