"""Randomly occurring sensor saturation (Song et al., (2)-(4))."""

from typing import NamedTuple

import numpy as np


class Saturation(NamedTuple):
    """What a filter knows of it."""

    probability: float  # gbar: that a sensor saturates at a step
    level: float  # kappa_max, in the unit of the measurement


def saturated(value: np.ndarray, level: float) -> np.ndarray:
    """Sat(value) = sign(value) min(level, |value|) of (3)."""
    return np.clip(value, -level, level)


def occurrences(uniforms: np.ndarray, probability: float) -> np.ndarray:
    """gamma of (4), one uniform each: 1 with the probability. Sweeps of it share the uniforms."""
    return (uniforms < probability).astype(float)


def output(level: np.ndarray, gamma: np.ndarray, saturation: Saturation) -> np.ndarray:
    """Noise-free output of (2): the saturation acts on h(x), not on h(x) + nu."""
    return np.where(gamma == 1, saturated(level, saturation.level), level)
