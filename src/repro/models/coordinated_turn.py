"""Coordinated turn and range measurement [packet_delays (40)-(42)].

State (px, py, vx, vy, omega): m, m, m/s, m/s, rad/s. The printed "k omega(k)" is read as the turn
angle T omega over the sampling time T. det f' = 1 for every state, so that f' is invertible.
"""

import numpy as np

from repro.kernels import turn_and_schedule as kernels
from repro.models.sparse import Rows

RANGE_FLOOR = 1e-6  # m; the bearing of a target on its sensor is undefined


def _components(x: np.ndarray) -> np.ndarray:
    """As the kernels have the states (..., 5): (5, states)."""
    return np.ascontiguousarray(np.moveaxis(x, -1, 0), dtype=float).reshape(5, -1)


def transition(x: np.ndarray, time: float) -> np.ndarray:
    """f(x) of (40) over the time T in s; x of shape (..., 5); component-major in memory."""
    out = np.empty((5, *x.shape[:-1]))
    kernels.transition(_components(x), float(time), out.reshape(5, -1))
    return np.moveaxis(out, 0, -1)


def transition_jacobian(x: np.ndarray, time: float) -> Rows:
    """f'(x) as sparse rows; last column as printed below (41)."""
    out = np.empty((8, *x.shape[:-1]))
    kernels.jacobian(_components(x), float(time), out.reshape(8, -1))
    along, across, cosine, sine, *last = out
    return [
        {0: 1.0, 2: along, 3: across, 4: last[0]},
        {1: 1.0, 2: -across, 3: along, 4: last[1]},
        {2: cosine, 3: -sine, 4: last[2]},
        {2: sine, 3: cosine, 4: last[3]},
        {4: 1.0},
    ]


def distance(x: np.ndarray, sensor: np.ndarray) -> np.ndarray:
    """h(x) of (42): range in m from position (..., 5) to sensor (..., 2)."""
    dx, dy = x[..., 0] - sensor[..., 0], x[..., 1] - sensor[..., 1]
    return np.sqrt(dx * dx + dy * dy)


def distance_jacobian(x: np.ndarray, sensor: np.ndarray) -> Rows:
    """Row H of (42); two entries are not zero (the printed third is a misprint)."""
    floored = np.maximum(distance(x, sensor), RANGE_FLOOR)
    return [{i: (x[..., i] - sensor[..., i]) / floored for i in (0, 1)}]
