"""Exact second moments of plant and filter for filters xh <- F xh + K y [packet_delays (6)].

Y = [X, xh] stacks the augmented plant and the estimate. Its second moment follows a linear
recursion for any F and K, so that a filter's true mean square error needs no sampling.
"""

import numpy as np

from repro.filters.families.delay_augmentation import augment, joint_moment
from repro.filters.families.linear_filters import Dynamics, propagated
from repro.models import LinearModel
from repro.network.packet_delays import mean_weights


def initial(model: LinearModel, state_moment: np.ndarray) -> np.ndarray:
    """Second moment of Y(0) when E[x(0) x(0)'] = state_moment and xh(0) is the initial mean.

    It holds for the initial mean 0 of the linear example, where xh(0) = 0.
    """
    return _beside_zeros(joint_moment(model, state_moment), len(model.initial_mean))


def predict(model: LinearModel, moment: np.ndarray, k: int) -> np.ndarray:
    """Second moment of [X(k+1), xh(k)]."""
    phi, noise = augment(model, k)
    size, n = len(phi), len(model.initial_mean)
    transition = np.eye(size + n)
    transition[:size, :size] = phi
    return propagated(Dynamics(transition, _beside_zeros(noise, n)), moment)


def _beside_zeros(moment: np.ndarray, n: int) -> np.ndarray:
    """Second moment of [X, 0] from that of X, n zeros."""
    size = len(moment)
    joint = np.zeros((size + n, size + n))
    joint[:size, :size] = moment
    return joint


def with_measurement(model: LinearModel, moment: np.ndarray) -> tuple[np.ndarray, float]:
    """E[Y y] and E[y^2] for the y received in that step, which is one random entry of X."""
    n = len(model.initial_mean)
    weights = mean_weights(model.network.arrival_probability, model.network.bound)
    z = slice(n, n + len(weights))
    return (moment[:, z] * weights).sum(axis=1), float((weights * np.diagonal(moment)[z]).sum())


def update(
    model: LinearModel, moment: np.ndarray, transfer: np.ndarray, gain: np.ndarray
) -> np.ndarray:
    """Second moment of [X(k+1), xh(k+1)] after xh <- F xh + K y, F (n, n) and K (n,)."""
    n, size = len(gain), len(moment) - len(gain)
    weights = mean_weights(model.network.arrival_probability, model.network.bound)
    cross, power = with_measurement(model, moment)
    transition = np.eye(size + n)
    transition[size:, size:] = transfer
    transition[size:, n:size] = gain[:, None] * weights  # K E y, by the entries of X
    spread = power - float((weights * cross[n:size]).sum())  # of y over the delays
    noise = np.zeros(moment.shape)
    noise[size:, size:] = spread * gain[:, None] * gain
    return propagated(Dynamics(transition, noise), moment)


def mean_square_error(moment: np.ndarray, n: int) -> np.ndarray:
    """E[(x - xh)(x - xh)'] from the second moment of [X, xh], (n, n)."""
    size = len(moment) - n
    cross = moment[:n, size:]
    return moment[:n, :n] - cross - cross.T + moment[size:, size:]
