"""Target tracking by radar [unknown_losses Sec. VI-B, (21)], after Singer (1970).

State (p1, v1, a1, p2, v2, a2): m, m/s, m/s^2 along two axes; the radar is at the origin.
"""

import numpy as np

from repro.kernels import radar_measurement as kernels
from repro.models.sparse import Rows

STATE = ("p1", "v1", "a1", "p2", "v2", "a2")
RANGE_FLOOR = 1e-6  # m; the bearing of a target on the radar is undefined


def transition_matrix(period: float) -> np.ndarray:
    """F of (21) for both axes, (6, 6); the period tau in s."""
    axis = [[1.0, period, 0.5 * period * period], [0.0, 1.0, period], [0.0, 0.0, 1.0]]
    return np.kron(np.eye(2), axis)


def process_covariance(period: float, manoeuvre_rate: float, acceleration: float) -> np.ndarray:
    """Q = 2 alpha sigma_m^2 times the printed matrix of powers of tau, for both axes, (6, 6)."""
    t, t2 = period, period * period
    powers = [
        [t2 * t2 * t / 20, t2 * t2 / 8, t2 * t / 6],
        [t2 * t2 / 8, t2 * t / 3, t2 / 2],
        [t2 * t / 6, t2 / 2, t],
    ]
    return 2 * manoeuvre_rate * (acceleration * acceleration) * np.kron(np.eye(2), powers)


def initial_covariance(period: float, range_deviation: float) -> np.ndarray:
    """Sigma_0 of two-point initialisation, for both axes, (6, 6): singular, acceleration known."""
    s, t = range_deviation * range_deviation, period
    axis = [[s, s / t, 0.0], [s / t, 2 * s / (t * t), 0.0], [0.0, 0.0, 0.0]]
    return np.kron(np.eye(2), axis)


def measurement(x: np.ndarray, bearing: str) -> np.ndarray:
    """Range in m and bearing in rad, (..., 2); `bearing` "arctan" is as printed."""
    p1, p2 = _positions(x)
    measured = np.empty((2, p1.size))
    kernels.measure(p1, p2, bearing == "arctan", measured[0], measured[1])
    return measured.reshape(2, *x.T.shape[1:]).T


def measurement_jacobian(x: np.ndarray) -> Rows:
    """The linearised measurement equation of Sec. VI-B, two rows."""
    p1, p2 = _positions(x)
    entries = np.empty((4, p1.size))
    kernels.linearise(p1, p2, RANGE_FLOOR, entries)
    along_1, along_2, across_1, across_2 = (e.reshape(x.T.shape[1:]).T for e in entries)
    return [{0: along_1, 3: along_2}, {0: across_1, 3: across_2}]


def wrapped_innovation(received: np.ndarray, expected: np.ndarray) -> np.ndarray:
    """Received minus expected, (..., 2), the difference of bearings wrapped to [-pi, pi)."""
    difference = np.subtract(received.T, expected.T, order="C")
    difference[1] -= 2 * np.pi * np.floor((difference[1] + np.pi) / (2 * np.pi))
    return difference.T


def _positions(x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """p1 and p2 of states (..., 6), the first axis innermost."""
    components = x.T
    return components[0].ravel(), components[3].ravel()
