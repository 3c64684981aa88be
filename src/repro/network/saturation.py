"""Randomly occurring sensor saturation [energy_harvesting (2)-(4)]."""

from typing import NamedTuple

import numpy as np


class Saturation(NamedTuple):
    """What a filter knows of the saturation."""

    probability: float  # gbar, that a sensor saturates at a step
    level: float  # kappa_max, in the unit of the measurement


def saturated(value: np.ndarray, level: float) -> np.ndarray:
    """Sat(value) = sign(value) min(level, |value|) (3)."""
    return np.clip(value, -level, level)


def occurrences(uniforms: np.ndarray, probability: float) -> np.ndarray:
    """gamma, 1 with this probability, from one uniform each, which sweeps can share (4)."""
    return (uniforms < probability).astype(float)


def output(level: np.ndarray, gamma: np.ndarray, saturation: Saturation) -> np.ndarray:
    """Noise-free output: the saturation acts on h(x), not on h(x) + nu (2)."""
    return np.where(gamma == 1, saturated(level, saturation.level), level)
