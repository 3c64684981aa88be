"""The systems that are estimated: dynamics and ideal sensors, as a filter knows them.

Arrays have trailing state axes and free leading axes: a state is (..., n), a Jacobian (..., n, n).
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from repro.models.sparse import Jacobian

# Position of the sensor that measures, (..., 2), where a study schedules sensors; None elsewhere.
Sensor = Any

MatrixOfStep = Callable[[int], np.ndarray]  # k -> A(k), (n, n)
Transition = Callable[[np.ndarray, int], np.ndarray]  # (x, k) -> f(x), (..., n), a new array
TransitionJacobian = Callable[[np.ndarray, int], Jacobian]  # (x, k) -> f'(x), n rows
Measurement = Callable[[np.ndarray, Sensor], np.ndarray]  # (x, sensor) -> h(x), (..., m)
MeasurementJacobian = Callable[[np.ndarray, Sensor], Jacobian]  # (x, sensor) -> h'(x), m rows
# (received, expected) -> their difference, (..., m), in which angles are wrapped
Difference = Callable[[np.ndarray, np.ndarray], np.ndarray]
# (x, u, k) -> f(x, u), (..., n), and its Jacobian by x, dense, (..., n, n)
Linearised = Callable[[np.ndarray, np.ndarray, int], tuple[np.ndarray, np.ndarray]]


class LinearModel(NamedTuple):
    """x(k+1) = A(k) x(k) + w(k), z(k) = c x(k) + v(k), with what is known of the network."""

    transition_matrix: MatrixOfStep  # k -> A(k)
    measurement_row: np.ndarray  # c, (n,)
    process_covariance: np.ndarray  # Q, (n, n)
    measurement_variance: float  # R
    initial_mean: np.ndarray  # (n,)
    initial_covariance: np.ndarray  # P(0|0), (n, n)
    initial_second_moment: np.ndarray  # S(0) = E[x(0) x(0)'], (n, n)
    network: Any = None  # e.g. DelayNetwork


class Model(NamedTuple):
    """x(k+1) = f(x(k)) + w(k), z(k) = h(x(k)) + v(k), z of m components, with f' and h'.

    A Jacobian is an array, constant or of each state, or sparse rows (repro.models.sparse).
    """

    transition: Transition
    transition_jacobian: TransitionJacobian
    measurement: Measurement
    measurement_jacobian: MeasurementJacobian
    process_covariance: np.ndarray  # Q, (n, n)
    measurement_covariance: np.ndarray  # R, (m, m)
    initial_mean: np.ndarray  # (n,)
    initial_covariance: np.ndarray  # (n, n)
    network: Any = None  # what a filter knows of it: DelayNetwork, repro.network.losses.Losses
    innovation: Difference = np.subtract
    linearised: Linearised | None = None  # instead of the first two, where an input u is known


class DelayNetwork(NamedTuple):
    """What a filter knows of the packet-delay network: p and N, never an arrival."""

    arrival_probability: float
    bound: int
