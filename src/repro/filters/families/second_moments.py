"""Exact second moments of plant and filter for filters xh <- F xh + K y [packet_delays (6)].

Y = [X, xh] stacks the augmented plant and the estimate. Its second moment follows a linear
recursion for any F and K, so that a filter's true mean square error needs no sampling.
"""

import numpy as np

from repro.filters.families.delay_augmentation import augment, initial_moment
from repro.models import LinearModel
from repro.network.packet_delays import mean_weights


def initial(model: LinearModel, state_moment: np.ndarray) -> np.ndarray:
    """Second moment of Y(0) when E[x(0) x(0)'] = state_moment and xh(0) is the initial mean.

    It holds for the initial mean 0 of the linear example, where xh(0) = 0.
    """
    n = len(model.initial_mean)
    size = n + model.network.bound + 1
    moment = np.zeros((size + n, size + n))
    moment[:size, :size] = initial_moment(model, state_moment)
    return moment


def predict(model: LinearModel, moment: np.ndarray, k: int) -> np.ndarray:
    """Second moment of [X(k+1), xh(k)]."""
    phi, noise = augment(model, k)
    size = len(phi)
    moved = moment.copy()
    moved[:size, :size] = phi @ moment[:size, :size] @ phi.T + noise
    moved[:size, size:] = phi @ moment[:size, size:]
    moved[size:, :size] = moved[:size, size:].T
    return moved


def with_measurement(model: LinearModel, moment: np.ndarray) -> tuple[np.ndarray, float]:
    """E[Y y] and E[y^2] for the y received in that step, which is one random entry of X."""
    n = len(model.initial_mean)
    weights = mean_weights(model.network.arrival_probability, model.network.bound)
    z = slice(n, n + len(weights))
    return moment[:, z] @ weights, float(weights @ np.diagonal(moment)[z])


def update(
    model: LinearModel, moment: np.ndarray, transfer: np.ndarray, gain: np.ndarray
) -> np.ndarray:
    """Second moment of [X(k+1), xh(k+1)] after xh <- F xh + K y, F (n, n) and K (n,)."""
    n = len(gain)
    cross, power = with_measurement(model, moment)
    size = len(moment) - n
    updated = moment.copy()
    updated[:size, size:] = moment[:size, size:] @ transfer.T + np.outer(cross[:size], gain)
    updated[size:, :size] = updated[:size, size:].T
    mixed = np.outer(transfer @ cross[size:], gain)
    updated[size:, size:] = (
        transfer @ moment[size:, size:] @ transfer.T
        + mixed
        + mixed.T
        + power * np.outer(gain, gain)
    )
    return updated


def mean_square_error(moment: np.ndarray, n: int) -> np.ndarray:
    """E[(x - xh)(x - xh)'] from the second moment of [X, xh], (n, n)."""
    size = len(moment) - n
    cross = moment[:n, size:]
    return moment[:n, :n] - cross - cross.T + moment[size:, size:]
