"""The linear plant augmented by its last N + 1 measurements, X(k) = [x(k), z(k), ..., z(k-N)].

The received y(k) of [packet_delays (2)] is one random entry of X(k) without further noise. The
problem is then linear with white random parameters, as the exact linear filters need it.
"""

import numpy as np

from repro.filters.families.linear_filters import Dynamics, System
from repro.models import LinearModel


def augmented(model: LinearModel) -> System:
    """The system of X."""
    return System(
        lambda k: augment(model, k),
        initial_mean(model),
        joint_moment(model, model.initial_covariance),
        joint_moment(model, model.initial_second_moment),
        0.0,
        len(model.initial_mean),
    )


def entries(model: LinearModel) -> np.ndarray:
    """The rows of X that are z(k), ..., z(k-N), (N + 1, n + N + 1)."""
    n = len(model.initial_mean)
    return np.eye(n + model.network.bound + 1)[n:]


def measured(model: LinearModel, matrix: np.ndarray) -> np.ndarray:
    """c times a matrix (n, n)."""
    return (model.measurement_row[:, None] * matrix).sum(axis=0)


def augment(model: LinearModel, k: int) -> Dynamics:
    """Phi and the noise covariance of X(k) -> X(k+1)."""
    n, size = len(model.initial_mean), len(model.initial_mean) + model.network.bound + 1
    transition = np.zeros((size, size))
    transition[:n, :n] = model.transition_matrix(k)
    transition[n, :n] = measured(model, transition[:n, :n])
    transition[range(n + 1, size), range(n, size - 1)] = 1.0
    return Dynamics(transition, joint_moment(model, model.process_covariance))


def joint_moment(model: LinearModel, moment: np.ndarray) -> np.ndarray:
    """Moment of [e, c e + v(k), 0, ..., 0] for that of e, (n + N + 1, n + N + 1).

    Of the noise, and of X(0): z(0) = c x(0) + v(0), and z(j) = 0 for j < 0.
    """
    n, size = len(model.initial_mean), len(model.initial_mean) + model.network.bound + 1
    joint = np.zeros((size, size))
    joint[:n, :n] = moment
    joint[n, :n] = joint[:n, n] = measured(model, moment)
    joint[n, n] = (joint[n, :n] * model.measurement_row).sum() + model.measurement_variance
    return joint


def initial_mean(model: LinearModel) -> np.ndarray:
    """Mean of X(0)."""
    before = np.zeros(model.network.bound)
    first = (model.measurement_row * model.initial_mean).sum()
    return np.concatenate([model.initial_mean, [first], before])
