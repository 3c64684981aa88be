"""White-noise acceleration and received-signal-strength sensors [energy_harvesting (30)-(32)].

The state is [s_x v_x s_y v_y (s_z v_z)], in m and m/s; the positions are components 0, 2 (, 4).
"""

from typing import NamedTuple

import numpy as np

from repro.kernels import arrays
from repro.kernels.sensed_plants import SQUARED_DISTANCE_FLOOR


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
    scale = np.sqrt(acceleration_variance * time)
    return scale * np.array([[time / np.sqrt(3.0), 0.0], [np.sqrt(3.0) / 2.0, 0.5]])


def move(x: np.ndarray, noise: np.ndarray, time: float, root: np.ndarray) -> np.ndarray:
    """x(k+1) from states and standard normals, (trials, n) each (30)."""
    position, velocity = x[:, 0::2], x[:, 1::2]
    first, second = noise[:, 0::2], noise[:, 1::2]
    following = np.empty_like(x)
    following[:, 0::2] = position + time * velocity + root[0, 0] * first
    following[:, 1::2] = velocity + root[1, 0] * first + root[1, 1] * second
    return following


def level(
    x: np.ndarray, sensor: np.ndarray, power: float, exponent: float, reference: float
) -> np.ndarray:
    """h^i(x) in dBm, (trials, ...), from states (trials, n, ...) and a position (axes,) (32)."""
    squared = np.zeros(x[:, 0].shape)
    for axis in range(len(sensor)):
        squared += (x[:, 2 * axis] - sensor[axis]) ** 2
    # 10 n_r log10(d/d0) = 5 n_r log10(d^2/d0^2): no square root
    of_distance = arrays.log10(np.maximum(squared, SQUARED_DISTANCE_FLOOR))
    return power + 10 * exponent * arrays.log10(reference) - 5 * exponent * of_distance
