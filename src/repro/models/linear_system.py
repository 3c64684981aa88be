"""A linear system with constant matrices: x(k+1) = F x(k) + u, z(k) = H x(k)."""

import numpy as np

from repro.kernels import kalman_step
from repro.models.sparse import terms

SWEEPS = 12  # of Jacobi's iteration, which converges quadratically: half as many suffice


def product(matrix: np.ndarray, x: np.ndarray, start: np.ndarray | None = None) -> np.ndarray:
    """Matrix (m, n) times states (..., n), plus `start` (m,); component-major in memory."""
    components = x.T
    batch, m = components.shape[1:], len(matrix)
    values = np.empty((m, components[0].size))
    kalman_step.product(
        terms(matrix, values.shape[1]),
        np.array(components.reshape(len(components), -1), dtype=float, order="C", copy=None),
        np.zeros(m) if start is None else start,
        values,
    )
    return values.reshape(m, *batch).T


def trajectory(matrix: np.ndarray, x0: np.ndarray, inputs: np.ndarray) -> np.ndarray:
    """States (trials, steps, n) from x(0), (trials, n), and inputs (trials, steps - 1, n)."""
    states = np.empty((len(x0), inputs.shape[1] + 1, x0.shape[1]))
    states[:, 0] = x0
    for k in range(inputs.shape[1]):
        states[:, k + 1] = product(matrix, states[:, k]) + inputs[:, k]
    return states


def gaussian(covariance: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """Draws of N(0, covariance) from standard normals (..., n)."""
    return product(root(covariance), normals)


def root(covariance: np.ndarray) -> np.ndarray:
    """Symmetric square root of a covariance, which may be singular, by Jacobi's eigenvalues."""
    rest, vectors = np.array(covariance, dtype=float), np.eye(len(covariance))
    for _ in range(SWEEPS):
        for p, q in zip(*np.triu_indices(len(rest), 1), strict=True):
            if rest[p, q] == 0.0:
                continue
            # The rotation of rows and columns p, q that makes the entry (p, q) zero
            gap, twice = rest[q, q] - rest[p, p], 2.0 * rest[p, q]
            distance = np.sqrt(gap * gap + twice * twice)
            tangent = twice / (gap + distance if gap > 0.0 else gap - distance)
            cosine = 1.0 / np.sqrt(tangent * tangent + 1.0)
            sine = tangent * cosine
            for of in (rest, rest.T, vectors.T):
                of[p], of[q] = cosine * of[p] - sine * of[q], sine * of[p] + cosine * of[q]
            rest[p, q] = rest[q, p] = 0.0
    values = np.sqrt(np.maximum(np.diagonal(rest), 0.0))
    return (vectors[:, None, :] * values * vectors).sum(axis=-1)
