"""White-noise acceleration and received-signal-strength sensors [energy_harvesting (30)-(32)].

The state is [s_x v_x s_y v_y (s_z v_z)], in m and m/s; the positions are components 0, 2 (, 4).
"""

from typing import NamedTuple

import numpy as np

SQUARED_DISTANCE_FLOOR = 1e-12  # m^2: a target on its sensor has a finite level


class SignalStrength(NamedTuple):
    """The target and its sensors as data."""

    time: float  # sampling time, s
    root: np.ndarray  # of one axis, (2, 2)
    sensors: np.ndarray  # positions, (N, axes), m
    power: float  # at the reference distance, dBm
    exponent: float  # of the path loss
    reference: float  # distance, m


def process_root(time: float, acceleration_variance: float) -> np.ndarray:
    """Lower Cholesky factor of Q for one axis, (2, 2) (31)."""
    q = [[time**3 / 3, time**2 / 2], [time**2 / 2, time]]
    return np.linalg.cholesky(acceleration_variance * np.array(q))


def move(x: np.ndarray, noise: np.ndarray, time: float, root: np.ndarray) -> np.ndarray:
    """x(k+1), written over x; states and standard normals are (trials, n, ...) (30).

    The normals are overwritten, too.
    """
    position, velocity = x[:, 0::2], x[:, 1::2]
    first, second = noise[:, 0::2], noise[:, 1::2]
    position += time * velocity
    position += root[0, 0] * first
    first *= root[1, 0]
    second *= root[1, 1]
    velocity += first
    velocity += second
    return x


def level(
    x: np.ndarray, sensor: np.ndarray, power: float, exponent: float, reference: float
) -> np.ndarray:
    """h^i(x) in dBm, (trials, ...), from states (trials, n, ...) and a position (axes,) (32)."""
    squared = x[:, 0] - sensor[0]
    squared *= squared
    for axis in range(1, len(sensor)):
        offset = x[:, 2 * axis] - sensor[axis]
        offset *= offset
        squared += offset
    np.maximum(squared, SQUARED_DISTANCE_FLOOR, out=squared)
    # 10 n_r log10(d/d0) = 5 n_r log10(d^2/d0^2): no square root
    np.log(squared, out=squared)
    squared *= -5 * exponent / np.log(10)
    squared += power + 10 * exponent * np.log10(reference)
    return squared
