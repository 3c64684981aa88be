"""The linear plant augmented by its last N + 1 measurements, X(k) = [x(k), z(k), ..., z(k-N)].

The received y(k) of [packet_delays (2)] is one random entry of X(k) without further noise. The
problem is then linear with white random parameters, as the exact linear filters need it.
"""

from typing import NamedTuple

import numpy as np

from repro.models import LinearModel


class Augmented(NamedTuple):
    """Dynamics of X."""

    transition: np.ndarray  # Phi(k), (n + N + 1, n + N + 1)
    noise_covariance: np.ndarray  # of the same shape


def augment(model: LinearModel, k: int) -> Augmented:
    """Phi and the noise covariance of X(k) -> X(k+1)."""
    n, size = len(model.initial_mean), len(model.initial_mean) + model.network.bound + 1
    a, c = model.transition_matrix(k), model.measurement_row
    transition = np.zeros((size, size))
    transition[:n, :n] = a
    transition[n, :n] = c @ a
    transition[range(n + 1, size), range(n, size - 1)] = 1.0
    enter = np.zeros((size, n))  # how w(k) enters
    enter[:n] = np.eye(n)
    enter[n] = c
    noise = enter @ model.process_covariance @ enter.T
    noise[n, n] += model.measurement_variance
    return Augmented(transition, noise)


def initial_moment(model: LinearModel, state_moment: np.ndarray) -> np.ndarray:
    """Moment of X(0) for a moment of x(0): z(0) = c x(0) + v(0), and z(j) = 0 for j < 0."""
    n, size = len(model.initial_mean), len(model.initial_mean) + model.network.bound + 1
    c = model.measurement_row
    moment = np.zeros((size, size))
    moment[:n, :n] = state_moment
    moment[n, :n] = moment[:n, n] = c @ state_moment
    moment[n, n] = c @ state_moment @ c + model.measurement_variance
    return moment


def initial_mean(model: LinearModel) -> np.ndarray:
    """Mean of X(0)."""
    before = np.zeros(model.network.bound)
    first = model.measurement_row @ model.initial_mean
    return np.concatenate([model.initial_mean, [first], before])
