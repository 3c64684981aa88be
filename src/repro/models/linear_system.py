"""A linear system with constant matrices: x(k+1) = F x(k) + u, z(k) = H x(k)."""

import numpy as np

from repro.models.sparse import Rows, combine


def product(matrix: Rows, x: np.ndarray, known_input: np.ndarray | None = None) -> np.ndarray:
    """Matrix times states (..., n), plus u -> (..., rows); component-major in memory, if x is."""
    components = x.T
    values = np.empty((len(matrix), *components.shape[1:]))
    for i, row in enumerate(matrix):
        combine(row, components, values[i, ...])
        if known_input is not None and known_input[i] != 0:
            values[i] += known_input[i]
    return values.T


def trajectory(matrix: Rows, x0: np.ndarray, inputs: np.ndarray) -> np.ndarray:
    """States (trials, steps, n) from x(0), (trials, n), and inputs (trials, steps - 1, n)."""
    states = np.empty((len(x0), inputs.shape[1] + 1, x0.shape[1]))
    states[:, 0] = x0
    for k in range(inputs.shape[1]):
        states[:, k + 1] = product(matrix, states[:, k]) + inputs[:, k]
    return states


def root(covariance: np.ndarray) -> np.ndarray:
    """Symmetric square root of a covariance, which may be singular."""
    values, vectors = np.linalg.eigh(covariance)
    return (vectors * np.sqrt(np.maximum(values, 0.0))) @ vectors.T
