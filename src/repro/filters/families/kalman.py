"""The steps of extended Kalman filters, on many systems at once, component by component.

An estimate is (n, systems); a symmetric matrix is its upper triangle row by row, packed as
(n (n + 1) / 2, systems). All work is elementwise over the systems, so that no result depends on
the others of its batch, and zeros and ones of a Jacobian cost nothing (repro.models.sparse).
Where matrices are large and dense the products are stacks of small ones, a matrix a system.
"""

from collections.abc import Callable
from functools import cache
from typing import NamedTuple

import numpy as np

from repro.models import Model
from repro.models.sparse import as_rows, combine, component

DENSE_FROM = 64  # entries of the gain above which a stack of products is faster than its parts


class Innovation(NamedTuple):
    """What a measurement says about a predicted state, decorrelated: S = L D L', L unit lower."""

    rows: np.ndarray  # L^-1 C Sigma, (m, n, systems)
    variances: np.ndarray  # diagonal of D, (m, systems)
    values: np.ndarray  # L^-1 e, (m, systems)


_upper = cache(np.triu_indices)


@cache
def packed_places(n: int) -> np.ndarray:
    """Place of each entry (i, j) of a symmetric matrix in its packed triangle, (n, n)."""
    upper = _upper(n)
    places = np.zeros((n, n), dtype=np.intp)
    places[upper] = np.arange(len(upper[0]))
    places.T[upper] = places[upper]
    return places


def _unpacked(packed: np.ndarray, n: int) -> np.ndarray:
    """The matrices, (systems, n, n)."""
    return np.ascontiguousarray(packed.T).take(packed_places(n), axis=1)


def _packed(matrices: np.ndarray) -> np.ndarray:
    """Upper triangles of (systems, n, n), packed."""
    n = matrices.shape[-1]
    flat = matrices.reshape(-1, n * n)
    return np.ascontiguousarray(flat.take(np.ravel_multi_index(_upper(n), (n, n)), axis=1).T)


def diagonal(packed: np.ndarray, n: int) -> np.ndarray:
    """Diagonal of packed matrices, (n, systems)."""
    return packed[np.diagonal(packed_places(n))]


def start(model: Model, systems: int) -> tuple[np.ndarray, np.ndarray]:
    """The initial estimate and its packed covariance for every system."""
    covariance = model.initial_covariance[_upper(len(model.initial_mean))]
    mean, packed = (
        np.repeat(values[:, None], systems, axis=1) for values in (model.initial_mean, covariance)
    )
    return mean, packed


def predict(
    model: Model,
    estimate: np.ndarray,
    covariance: np.ndarray,
    k: int,
    known_input: np.ndarray | None = None,
) -> tuple[np.ndarray, np.ndarray]:
    """xh(k+1|k) = f(xh(k|k)) and A Sigma A' + Q with A = f'(xh(k|k)), in new arrays.

    The known input u(k), (systems, inputs), is None where the model has none.
    """
    if known_input is not None:
        assert model.linearised is not None
        predicted, jacobian = model.linearised(estimate.T, known_input, k)
        moved = jacobian @ _unpacked(covariance, len(estimate)) @ jacobian.swapaxes(-2, -1)
        packed = _packed(moved)
        packed += model.process_covariance[_upper(len(estimate))][:, None]
        return np.ascontiguousarray(predicted.T), packed
    jacobian = as_rows(model.transition_jacobian(estimate.T, k))
    predicted = np.ascontiguousarray(model.transition(estimate.T, k).T)
    n = len(jacobian)
    places, noise = packed_places(n), model.process_covariance
    packed = np.empty_like(covariance)
    product = np.empty_like(estimate)  # a row of A Sigma
    for i, row in enumerate(jacobian):
        for column in set().union(*jacobian[i:]):
            combine(row, {j: covariance[places[j, column]] for j in row}, product[column])
        for j in range(i, n):  # (A Sigma) A', upper triangle
            entry = packed[places[i, j]]
            combine(jacobian[j], product, entry)
            if noise[i, j] != 0:
                entry += noise[i, j]
    return predicted, packed


def innovate(
    model: Model, predicted: np.ndarray, covariance: np.ndarray, received: np.ndarray, sensor=None
) -> Innovation:
    """Innovation of the received values, (systems, m), at a prediction."""
    state = predicted.T
    values = np.ascontiguousarray(model.innovation(received, model.measurement(state, sensor)).T)
    jacobian = as_rows(model.measurement_jacobian(state, sensor))
    m, n, noise = len(jacobian), len(predicted), model.measurement_covariance
    places = packed_places(n)
    rows = np.empty((m, *predicted.shape))
    s = np.zeros((m, m, predicted.shape[1]))
    for i, row in enumerate(jacobian):  # C Sigma
        measured = component(row)
        if measured is not None:
            covariance.take(places[measured], axis=0, out=rows[i])
            continue
        for column in range(n):
            combine(row, {j: covariance[places[j, column]] for j in row}, rows[i, column])
    for i, row in enumerate(jacobian):  # (C Sigma) C' + R, lower triangle
        measured = component(row)
        if measured is not None:
            s[i:, i] = rows[i:, measured]
        else:
            for j in range(i, m):
                combine(row, rows[j], s[j, i])
        s[i:, i] += noise[i:, i, None]
    for i in range(m - 1):  # S = L D L'
        factors = s[i + 1 :, i] / s[i, i]
        rows[i + 1 :] -= factors[:, None] * rows[i]
        values[i + 1 :] -= factors * values[i]
        s[i + 1 :, i + 1 :] -= factors[:, None] * s[i + 1 :, i]
    return Innovation(rows, s[range(m), range(m)], values)


def log_likelihood(innovation: Innovation) -> np.ndarray:
    """log N(e; 0, S) without its constant m log(2 pi) / 2."""
    values = innovation.values
    return -0.5 * _summed(np.log(innovation.variances) + values * values / innovation.variances)


def noise_log_likelihood(model: Model) -> Callable[[np.ndarray], np.ndarray]:
    """log N(y; 0, R) without the same constant, as a function of values (systems, m)."""
    noise = model.measurement_covariance
    inverse, (_, log_determinant) = np.linalg.inv(noise), np.linalg.slogdet(noise)

    def of_noise(received: np.ndarray) -> np.ndarray:
        return -0.5 * (log_determinant + np.vecdot(np.vecmat(received, inverse), received))

    return of_noise


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
    shares = weight / innovation.variances
    m, n = innovation.rows.shape[:2]
    if m * n >= DENSE_FROM:
        rows = np.ascontiguousarray(np.moveaxis(innovation.rows, -1, 0))
        gains = rows * shares.T[:, :, None]
        estimate += np.vecmat(innovation.values.T, gains).T
        covariance -= _packed(gains.swapaxes(-2, -1) @ rows)
    else:
        _correct_by_component(estimate, covariance, innovation, shares)
    if spread:
        scaled = innovation.values / innovation.variances
        correction = _summed(innovation.rows * scaled[:, None])
        _add_outer(covariance, weight * (1 - weight) * correction, correction)
    return estimate, covariance


def _correct_by_component(
    estimate: np.ndarray, covariance: np.ndarray, innovation: Innovation, shares: np.ndarray
) -> None:
    for row, share, value in zip(innovation.rows, shares, innovation.values, strict=True):
        gain = row * share
        estimate += gain * value
        _add_outer(covariance, -gain, row)


def _add_outer(packed: np.ndarray, left: np.ndarray, right: np.ndarray) -> None:
    """Add the symmetric matrix left right', (n, systems) each, to a packed one."""
    first = 0
    for i in range(len(left)):
        last = first + len(left) - i
        packed[first:last] += left[i] * right[i:]
        first = last


def _summed(terms: np.ndarray) -> np.ndarray:
    """Sum over the first axis in its order, however many systems there are."""
    total = terms[0]
    for term in terms[1:]:
        total = total + term
    return total
