"""Target tracking by radar [unknown_losses Sec. VI-B, (21)], after Singer (1970).

State (p1, v1, a1, p2, v2, a2): m, m/s, m/s^2 along two axes; the radar is at the origin.
"""

import numpy as np

from repro.models.sparse import Rows

STATE = ("p1", "v1", "a1", "p2", "v2", "a2")
RANGE_FLOOR = 1e-6  # m; the bearing of a target on the radar is undefined


def transition_matrix(period: float) -> np.ndarray:
    """F of (21) for both axes, (6, 6); the period tau in s."""
    axis = [[1.0, period, period**2 / 2], [0.0, 1.0, period], [0.0, 0.0, 1.0]]
    return np.kron(np.eye(2), axis)


def process_covariance(period: float, manoeuvre_rate: float, acceleration: float) -> np.ndarray:
    """Q = 2 alpha sigma_m^2 times the printed matrix of powers of tau, for both axes, (6, 6)."""
    t = period
    powers = [
        [t**5 / 20, t**4 / 8, t**3 / 6],
        [t**4 / 8, t**3 / 3, t**2 / 2],
        [t**3 / 6, t**2 / 2, t],
    ]
    return 2 * manoeuvre_rate * acceleration**2 * np.kron(np.eye(2), powers)


def initial_covariance(period: float, range_deviation: float) -> np.ndarray:
    """Sigma_0 of two-point initialisation, for both axes, (6, 6): singular, acceleration known."""
    s, t = range_deviation**2, period
    return np.kron(np.eye(2), [[s, s / t, 0.0], [s / t, 2 * s / t**2, 0.0], [0.0, 0.0, 0.0]])


def measurement(x: np.ndarray, bearing: str) -> np.ndarray:
    """Range in m and bearing in rad, (..., 2); `bearing` "arctan" is as printed."""
    p1, p2 = x.T[0], x.T[3]
    measured = np.empty((2, *p1.shape))
    measured[0] = np.sqrt(p1 * p1 + p2 * p2)
    measured[1] = np.arctan(p2 / p1) if bearing == "arctan" else np.arctan2(p2, p1)
    return measured.T


def measurement_jacobian(x: np.ndarray) -> Rows:
    """The linearised measurement equation of Sec. VI-B, two rows."""
    p1, p2 = x[..., 0], x[..., 3]
    inverse = 1.0 / np.maximum(np.sqrt(p1 * p1 + p2 * p2), RANGE_FLOOR)
    cosine, sine = p1 * inverse, p2 * inverse
    return [{0: cosine, 3: sine}, {0: -sine * inverse, 3: cosine * inverse}]


def wrapped_innovation(received: np.ndarray, expected: np.ndarray) -> np.ndarray:
    """Received minus expected, (..., 2), the difference of bearings wrapped to [-pi, pi)."""
    difference = received.T - expected.T
    difference[1] -= 2 * np.pi * np.floor((difference[1] + np.pi) / (2 * np.pi))
    return difference.T
