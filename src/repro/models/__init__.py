"""The systems that are estimated: dynamics and ideal sensors, as a filter knows them.

Arrays have trailing state axes and free leading axes: a state is (..., n), a Jacobian (..., n, n).
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np


class LinearModel(NamedTuple):
    """x(k+1) = A(k) x(k) + w(k), z(k) = c x(k) + v(k), with what is known of the network."""

    transition_matrix: Callable[[int], np.ndarray]  # k -> A(k), (n, n)
    measurement_row: np.ndarray  # c, (n,)
    process_covariance: np.ndarray  # Q, (n, n)
    measurement_variance: float  # R
    initial_mean: np.ndarray  # (n,)
    initial_covariance: np.ndarray  # P(0|0), (n, n)
    initial_second_moment: np.ndarray  # S(0) = E[x(0) x(0)'], (n, n)
    network: Any = None


class Model(NamedTuple):
    """x(k+1) = f(x(k)) + w(k), z(k) = h(x(k)) + v(k), z of m components, with f' and h'.

    h takes the position of the sensor that measures, (..., 2), where a study schedules sensors;
    it is None elsewhere. Jacobians are sparse rows (repro.models.sparse).
    """

    transition: Callable  # (x, k) -> x(k+1) without noise, (..., n), a new array
    transition_jacobian: Callable  # (x, k) -> n rows
    measurement: Callable  # (x, sensor) -> (..., m)
    measurement_jacobian: Callable  # (x, sensor) -> m rows
    process_covariance: np.ndarray  # Q, (n, n)
    measurement_covariance: np.ndarray  # R, (m, m)
    initial_mean: np.ndarray
    initial_covariance: np.ndarray
    network: Any = None
    innovation: Callable = np.subtract  # (received, expected) -> (..., m); angles are wrapped
    # Of a system with a known input u, instead of the first two:
    # (x, u, k) -> f(x, u), (..., n), and its Jacobian, dense, (..., n, n)
    linearised: Callable | None = None


class DelayNetwork(NamedTuple):
    """What a filter knows of the packet-delay network: p and N, never an arrival."""

    arrival_probability: float
    bound: int
