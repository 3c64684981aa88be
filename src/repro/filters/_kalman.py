"""The steps of extended Kalman filters, on many systems at once, component by component.

An estimate is (n, *batch); a symmetric matrix is its upper triangle row by row, packed as
(n (n + 1) / 2, *batch). All work is elementwise over the batch, so that no result depends on what
else is in it, and zeros and ones of a Jacobian cost nothing (repro.models.sparse).
"""

from functools import cache
from typing import NamedTuple

import numpy as np

from repro.models import Model
from repro.models.sparse import Rows, combine


class Innovation(NamedTuple):
    """What a measurement says about a predicted state, decorrelated: S = L D L', L unit lower."""

    rows: np.ndarray  # L^-1 C Sigma, (m, n, *batch)
    variances: np.ndarray  # diagonal of D, (m, *batch)
    values: np.ndarray  # L^-1 e, (m, *batch)


_upper = cache(np.triu_indices)


@cache
def _places(n: int) -> np.ndarray:
    """Place of each entry (i, j) of a symmetric matrix in its packed triangle, (n, n)."""
    upper = _upper(n)
    places = np.zeros((n, n), dtype=np.intp)
    places[upper] = np.arange(len(upper[0]))
    places.T[upper] = places[upper]
    return places


def pack(matrix: np.ndarray) -> np.ndarray:
    """Upper triangle, row by row, of symmetric matrices (n, n, *batch)."""
    return matrix[_upper(len(matrix))]


def diagonal(packed: np.ndarray, n: int) -> np.ndarray:
    """Diagonal of packed matrices, (n, *batch)."""
    return packed[np.diagonal(_places(n))]


def start(model: Model, batch: tuple[int, ...]) -> tuple[np.ndarray, np.ndarray]:
    """The initial estimate and its packed covariance for every system of a batch."""
    spread = (slice(None), *(None,) * len(batch))
    return tuple(
        np.broadcast_to(values[spread], (len(values), *batch)).copy()
        for values in (model.initial_mean, pack(model.initial_covariance))
    )


def predict(
    model: Model, estimate: np.ndarray, covariance: np.ndarray, k: int
) -> tuple[np.ndarray, np.ndarray]:
    """xh(k+1|k) = f(xh(k|k)) and A Sigma A' + Q with A = f'(xh(k|k)), in new arrays."""
    state = np.moveaxis(estimate, 0, -1)
    jacobian = model.transition_jacobian(state, k)
    predicted = np.ascontiguousarray(np.moveaxis(model.transition(state, k), -1, 0))
    n = len(jacobian)
    full = covariance[_places(n)]
    left = np.empty_like(full)
    for i, row in enumerate(jacobian):  # A Sigma
        combine(row, full, left[i])
    columns = left.swapaxes(0, 1)
    for k, row in enumerate(jacobian):  # (A Sigma) A', upper triangle
        combine(row, columns[:, : k + 1], full[: k + 1, k])
    packed = pack(full)
    noise = pack(model.process_covariance)
    packed += noise.reshape(-1, *(1,) * (packed.ndim - 1))
    return predicted, packed


def innovate(
    model: Model, predicted: np.ndarray, covariance: np.ndarray, received: np.ndarray, sensor=None
) -> Innovation:
    """Innovation of `received`, (*batch, m) or what broadcasts to it, at a prediction."""
    state = np.moveaxis(predicted, 0, -1)
    expected = model.measurement(state, sensor)
    values = np.ascontiguousarray(np.moveaxis(model.innovation(received, expected), -1, 0))
    jacobian = model.measurement_jacobian(state, sensor)
    m, n, noise = len(jacobian), len(predicted), model.measurement_covariance
    places = _places(n)
    of_sigma = {j: covariance[places[j]] for j in sorted(set().union(*jacobian))}
    rows = np.empty((m, *predicted.shape))
    for i, row in enumerate(jacobian):  # C Sigma
        combine(row, of_sigma, rows[i])
    s = np.empty((m, m, *values.shape[1:]))
    for i, row in enumerate(jacobian):  # (C Sigma) C' + R, lower triangle
        for j in range(i, m):
            combine(row, rows[j], s[j, i])
            s[j, i] += noise[j, i]
    for i in range(m):  # S = L D L'
        for j in range(i + 1, m):
            factor = s[j, i] / s[i, i]
            rows[j] -= factor * rows[i]
            values[j] -= factor * values[i]
            for l in range(i + 1, j + 1):
                s[j, l] -= factor * s[l, i]
    return Innovation(rows, s[range(m), range(m)], values)


def log_likelihood(innovation: Innovation) -> np.ndarray:
    """log N(e; 0, S) without its constant m log(2 pi) / 2."""
    terms = np.log(innovation.variances) + innovation.values**2 / innovation.variances
    return -0.5 * _summed(terms)


def noise_log_likelihood(model: Model, received: np.ndarray) -> np.ndarray:
    """log N(y; 0, R) without the same constant, of values (..., m) that are noise alone."""
    noise = model.measurement_covariance
    inverse, (_, log_determinant) = np.linalg.inv(noise), np.linalg.slogdet(noise)
    whitened = np.moveaxis(np.vecmat(received, inverse) * received, -1, 0)
    return -0.5 * (log_determinant + _summed(whitened))


def correct(
    estimate: np.ndarray,
    covariance: np.ndarray,
    innovation: Innovation,
    weight: np.ndarray | float,
    spread: bool = False,
) -> tuple[np.ndarray, np.ndarray]:
    """xh + g K e and Sigma - g K C Sigma, in place; g = 0 leaves both as they are.

    With `spread` a weight between 0 and 1 is a probability of the measurement, and the spread of
    the means with and without it, g (1 - g) K e e' K', is added.
    """
    n = len(estimate)
    gains = innovation.rows / innovation.variances[:, None]
    correction = _summed(gains * innovation.values[:, None])
    estimate += weight * correction
    gains *= -weight
    for row, gain in zip(innovation.rows, gains, strict=True):
        _add_outer(covariance, gain, row)
    if spread:
        _add_outer(covariance, weight * (1 - weight) * correction, correction)
    return estimate, covariance


def _add_outer(packed: np.ndarray, left: np.ndarray, right: np.ndarray) -> None:
    """Add the symmetric matrix left right', (n, *batch) each, to a packed one."""
    first = 0
    for i in range(len(left)):
        last = first + len(left) - i
        packed[first:last] += left[i] * right[i:]
        first = last


def _summed(terms: np.ndarray) -> np.ndarray:
    """Sum over the first axis in its order, whatever the batch."""
    total = terms[0]
    for term in terms[1:]:
        total = total + term
    return total
