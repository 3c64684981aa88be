"""Randomly coupled targets and their signal-strength sensors [censored_network (23), (24)].

State of a target: (px, py, phi) in m, m, rad; phi is not wrapped. Speed and turn rate are per
step.
"""

from typing import NamedTuple

import numpy as np

from repro.kernels import arrays
from repro.kernels.censored_likelihood import FARTHEST_SQUARED, NEAREST_SQUARED
from repro.models.mixture_noise import MixtureNoise
from repro.network.censoring import Censoring


class SignalStrength(NamedTuple):
    """Phi_0 - 10 eta log10(distance / r_0) in dB: [censored_network (24)] without noise."""

    at_reference: float  # Phi_0 in dB
    path_loss_exponent: float  # eta
    reference_distance: float  # r_0 in m

    def of_log_squared_distance(self) -> tuple[float, float]:
        """(a, b) with strength = a + b log(d^2); log is natural and d in m."""
        slope = -5.0 * self.path_loss_exponent / arrays.log(10.0)
        return self.at_reference - 2.0 * slope * arrays.log(self.reference_distance), slope

    def of_squared_distance(self, squared: np.ndarray) -> np.ndarray:
        """Strength in dB from d^2 in m^2, any shape; finite also on a sensor."""
        a, b = self.of_log_squared_distance()
        return a + b * arrays.log(np.clip(squared, NEAREST_SQUARED, FARTHEST_SQUARED))


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

    x (..., nodes, 3), speed (nodes,).
    """
    px, py, phi = x[..., 0], x[..., 1], x[..., 2]
    moved = px + speed * arrays.cos(phi), py + speed * arrays.sin(phi), phi + turn_rate
    return np.stack(moved, axis=-1)


def pull(states: np.ndarray, coupling: np.ndarray) -> np.ndarray:
    """sum_j c^ij g(x^j) of [censored_network (23)], g the sine of each component.

    states (..., nodes, 3), coupling (nodes, nodes).
    """
    return (coupling[:, :, None] * arrays.sin(states)[..., None, :, :]).sum(axis=-2)
