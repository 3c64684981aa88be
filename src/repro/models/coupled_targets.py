"""Randomly coupled targets and their signal-strength sensors [censored_network (23), (24)].

State of a target: (px, py, phi) in m, m, rad; phi is not wrapped. Speed and turn rate are per
step. Clouds keep components before particles, (..., nodes, 3, particles).
"""

from typing import NamedTuple

import numpy as np

from repro.models.mixture_noise import MixtureNoise
from repro.network.censoring import Censoring

# Distances are clipped to 1e-9 ... 1e9 m, so that every signal strength is finite.
SQUARED_DISTANCE = (1e-18, 1e18)


class SignalStrength(NamedTuple):
    """Phi_0 - 10 eta log10(distance / r_0) in dB: [censored_network (24)] without noise."""

    at_reference: float  # Phi_0 in dB
    path_loss_exponent: float  # eta
    reference_distance: float  # r_0 in m

    def of_log_squared_distance(self) -> tuple[float, float]:
        """(a, b) with strength = a + b log(d^2); log is natural and d in m."""
        slope = -5.0 * self.path_loss_exponent / np.log(10.0)
        return self.at_reference - slope * np.log(self.reference_distance**2), slope

    def range(self) -> tuple[float, float]:
        """The smallest and the largest strength, which the clipped distances give."""
        a, b = self.of_log_squared_distance()
        first, second = (float(a + b * np.log(d2)) for d2 in SQUARED_DISTANCE)
        return min(first, second), max(first, second)


class CoupledTargets(NamedTuple):
    """What a filter knows of targets, sensors and network."""

    initial_mean: np.ndarray  # of all targets in one row, (nodes * 3,)
    initial_deviation: np.ndarray  # of each component, (3,)
    speed: np.ndarray  # v of each target, m per step, (nodes,)
    turn_rate: float  # Omega, rad per step
    process_deviation: np.ndarray  # (3,)
    coupling: np.ndarray  # c, (nodes, nodes)
    coupling_rate: float  # alphabar
    sensors: np.ndarray  # positions in m, (M, b, 2), the same for every target
    strength: SignalStrength
    noise: MixtureNoise
    censoring: Censoring


def drift(x: np.ndarray, speed: np.ndarray, turn_rate: float) -> np.ndarray:
    """f of [censored_network (23)]: one step of uncoupled targets without noise.

    x (..., nodes, 3, particles), speed (nodes,).
    """
    # Cosine and sine from one tangent of the half angle, at a sixteenth of their cost.
    half = x[..., 2, :] * 0.5
    tangent = np.tan(half, out=half)
    scale = tangent * tangent
    along = 1.0 - scale
    scale += 1.0
    np.divide(speed[:, None], scale, out=scale)
    along *= scale
    tangent *= scale
    tangent += tangent
    moved = np.empty_like(x)
    np.add(x[..., 0, :], along, out=moved[..., 0, :])
    np.add(x[..., 1, :], tangent, out=moved[..., 1, :])
    np.add(x[..., 2, :], turn_rate, out=moved[..., 2, :])
    return moved


def pull(states: np.ndarray, coupling: np.ndarray) -> np.ndarray:
    """sum_j c^ij g(x^j) of [censored_network (23)], g the sine of each component.

    states (..., nodes, 3), coupling (nodes, nodes).
    """
    return coupling @ np.sin(states)


def log_squared_distance(x: np.ndarray, sensors: np.ndarray) -> np.ndarray:
    """log(d^2) from each particle to each sensor, (..., nodes, sensors, particles).

    x (..., nodes, 3, particles); sensors (sensors, 2) in m.
    """
    squared = x[..., 0:1, :] - sensors[:, 0, None]
    squared *= squared
    across = x[..., 1:2, :] - sensors[:, 1, None]
    across *= across
    squared += across
    np.clip(squared, *SQUARED_DISTANCE, out=squared)
    return np.log(squared, out=squared)
