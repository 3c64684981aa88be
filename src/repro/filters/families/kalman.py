"""The steps of extended Kalman filters, on many systems at once.

An estimate is (n, systems); a symmetric matrix is its upper triangle row by row, packed as
(n (n + 1) / 2, systems). The model is asked for all systems together, the matrix algebra is that
of `repro.kernels.kalman_step`, in which no result depends on the other systems of its batch.
"""

from collections.abc import Callable, Sequence
from functools import cache
from typing import NamedTuple

import numpy as np

from repro.kernels import kalman_step as kernels
from repro.models import Model
from repro.models.sparse import terms, terms_of_covariance


class Innovation(NamedTuple):
    """What a measurement says about a predicted state, decorrelated: S = L D L', L unit lower."""

    rows: np.ndarray  # L^-1 C Sigma, (m n, systems)
    precisions: np.ndarray  # diagonal of 1 / D, (m, systems)
    values: np.ndarray  # L^-1 e, (m, systems)
    log_likelihood: np.ndarray  # log N(e; 0, S) without its constant m log(2 pi) / 2, (systems,)


_upper = cache(np.triu_indices)


def variances(packed: np.ndarray, n: int) -> np.ndarray:
    """Diagonals of packed matrices, (n, systems)."""
    rows, columns = _upper(n)
    return packed[rows == columns]


def covariances(packed: np.ndarray, n: int, components: Sequence[int]) -> np.ndarray:
    """Rows and columns of packed matrices, (systems, d, d)."""
    places = np.zeros((n, n), dtype=np.int64)
    places[_upper(n)] = np.arange(len(packed))
    places = np.maximum(places, places.T)[np.ix_(components, components)]
    return np.moveaxis(packed[places], -1, 0)


def start(model: Model, systems: int) -> tuple[np.ndarray, np.ndarray]:
    """The initial estimate and its packed covariance for every system."""
    covariance = model.initial_covariance[_upper(len(model.initial_mean))]
    mean, packed = (
        np.repeat(values.astype(float)[:, None], systems, axis=1)
        for values in (model.initial_mean, covariance)
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
    n, systems = estimate.shape
    if known_input is None:
        jacobian = model.transition_jacobian(estimate.T, k)
        predicted = model.transition(estimate.T, k)
    else:
        assert model.linearised is not None
        predicted, jacobian = model.linearised(estimate.T, known_input, k)
    noise, after = model.process_covariance[_upper(n)].astype(float), np.empty_like(covariance)
    if isinstance(jacobian, np.ndarray) and jacobian.ndim == 2:
        lifted = terms_of_covariance(jacobian.astype(float).tobytes(), n)
        kernels.product(lifted, covariance, noise, after)
    else:
        moved = np.empty((n, kernels.PART))
        kernels.predict_covariance(terms(jacobian, systems), covariance, noise, moved, after)
    return np.array(predicted.T, dtype=float, order="C", copy=None), after


def innovate(
    model: Model, predicted: np.ndarray, covariance: np.ndarray, received: np.ndarray, sensor=None
) -> Innovation:
    """Innovation of the received values, (systems, m), at a prediction."""
    state, (n, systems) = predicted.T, predicted.shape
    expected = model.measurement(state, sensor)
    values = np.array(model.innovation(received, expected).T, dtype=float, order="C")
    m = len(values)
    found = Innovation(
        np.empty((m * n, systems)), np.empty((m, systems)), values, np.empty(systems)
    )
    kernels.innovate(
        terms(model.measurement_jacobian(state, sensor), systems),
        covariance,
        model.measurement_covariance.astype(float, order="C"),
        found.values,
        found.rows,
        found.precisions,
        found.log_likelihood,
        np.empty((m + 1, m, kernels.PART)),
    )
    return found


def normalised(innovation: Innovation) -> np.ndarray:
    """e' S^-1 e / m, (systems,)."""
    return (innovation.values**2 * innovation.precisions).mean(axis=0)


def noise_log_likelihood(model: Model) -> Callable[[np.ndarray], np.ndarray]:
    """log N(y; 0, R) without the same constant, as a function of values (systems, m)."""
    noise = model.measurement_covariance.astype(float, order="C")
    factors, of_factors = np.zeros_like(noise), np.empty(len(noise))
    kernels.factorise(noise, factors, of_factors)

    def of_noise(received: np.ndarray) -> np.ndarray:
        found = np.empty(len(received))
        values = np.array(received, dtype=float, order="C")
        kernels.noise_likelihood(values, factors, of_factors, found)
        return found

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
    n, systems = estimate.shape
    weights = np.full(systems, weight, dtype=float)
    known = innovation.rows, innovation.precisions, innovation.values, weights
    kernels.correct(*known, estimate, covariance, np.empty((4, kernels.PART)))
    if spread:
        kernels.add_spread(*known, covariance, np.empty((n, kernels.PART)))
    return estimate, covariance
