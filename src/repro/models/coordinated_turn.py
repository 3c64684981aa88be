"""Coordinated turn and range measurement [packet_delays (40)-(42)].

State (px, py, vx, vy, omega): m, m, m/s, m/s, rad/s. The printed "k omega(k)" is read as the turn
angle T omega over the sampling time T. det f' = 1 for every state, so that f' is invertible.
"""

import numpy as np

from repro.models.sparse import Rows

SERIES_BELOW = 1e-3  # |omega T| below which the 0/0 quotients are taken from their series
RANGE_FLOOR = 1e-6  # m; the bearing of a target on its sensor is undefined


def _quotients(
    omega: np.ndarray, time: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """sin(a)/omega and (cos(a) - 1)/omega for a = omega T, and their derivatives by omega."""
    angle = omega * time
    near = np.abs(angle) < SERIES_BELOW
    some = near.any()
    safe = np.where(near, 1.0, omega) if some else omega
    a = safe * time
    sine, cosine = np.sin(a), np.cos(a)
    along, across = sine / safe, (cosine - 1) / safe
    d_along, d_across = (a * cosine - sine) / safe**2, -(a * sine + cosine - 1) / safe**2
    if some:
        along = np.where(near, time * (1 - angle**2 / 6), along)
        across = np.where(near, -time * angle / 2 * (1 - angle**2 / 12), across)
        d_along = np.where(near, -(time**2) * angle / 3, d_along)
        d_across = np.where(near, -(time**2) / 2 * (1 - angle**2 / 4), d_across)
    return along, across, d_along, d_across


def transition(x: np.ndarray, time: float) -> np.ndarray:
    """f(x) of (40) over the time T in s; x of shape (..., 5)."""
    px, py, vx, vy, omega = np.moveaxis(x, -1, 0)
    along, across, _, _ = _quotients(omega, time)
    sine, cosine = np.sin(omega * time), np.cos(omega * time)
    return np.stack(
        [
            px + along * vx + across * vy,
            py - across * vx + along * vy,
            cosine * vx - sine * vy,
            sine * vx + cosine * vy,
            omega,
        ],
        axis=-1,
    )


def transition_jacobian(x: np.ndarray, time: float) -> Rows:
    """f'(x) as sparse rows; last column as printed below (41)."""
    vx, vy, omega = x[..., 2], x[..., 3], x[..., 4]
    along, across, d_along, d_across = _quotients(omega, time)
    sine, cosine = np.sin(omega * time), np.cos(omega * time)
    return [
        {0: 1.0, 2: along, 3: across, 4: d_along * vx + d_across * vy},
        {1: 1.0, 2: -across, 3: along, 4: -d_across * vx + d_along * vy},
        {2: cosine, 3: -sine, 4: -time * sine * vx - time * cosine * vy},
        {2: sine, 3: cosine, 4: time * cosine * vx - time * sine * vy},
        {4: 1.0},
    ]


def distance(x: np.ndarray, sensor: np.ndarray) -> np.ndarray:
    """h(x) of (42): range in m from position (..., 5) to sensor (..., 2)."""
    return np.hypot(x[..., 0] - sensor[..., 0], x[..., 1] - sensor[..., 1])


def distance_jacobian(x: np.ndarray, sensor: np.ndarray) -> Rows:
    """Row H of (42); two entries are not zero (the printed third is a misprint)."""
    floored = np.maximum(distance(x, sensor), RANGE_FLOOR)
    return [{i: (x[..., i] - sensor[..., i]) / floored for i in (0, 1)}]
