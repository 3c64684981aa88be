"""A linear system with constant matrices: x(k+1) = F x(k), z(k) = H x(k)."""

import numpy as np

from repro.models.sparse import Rows, combine


def product(matrix: Rows, x: np.ndarray) -> np.ndarray:
    """Matrix times states (..., n) -> (..., rows); component-major in memory, if x is."""
    components = x.T
    values = np.empty((len(matrix), *components.shape[1:]))
    for i, row in enumerate(matrix):
        combine(row, components, values[i, ...])
    return values.T


def trajectory(matrix: Rows, x0: np.ndarray, noise: np.ndarray) -> np.ndarray:
    """States (trials, steps, n) from x(0) (trials, n) and process noise (trials, steps - 1, n)."""
    states = np.empty((len(x0), noise.shape[1] + 1, x0.shape[1]))
    states[:, 0] = x0
    for k in range(noise.shape[1]):
        states[:, k + 1] = product(matrix, states[:, k]) + noise[:, k]
    return states


def root(covariance: np.ndarray) -> np.ndarray:
    """Symmetric square root of a covariance, which may be singular."""
    values, vectors = np.linalg.eigh(covariance)
    return (vectors * np.sqrt(np.maximum(values, 0.0))) @ vectors.T
