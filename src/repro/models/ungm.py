"""Univariate nonstationary growth model with Gamma noise [energy_harvesting (29)]."""

from typing import NamedTuple

import numpy as np

from repro.kernels import arrays
from repro.streams import Streams


class Growth(NamedTuple):
    """The plant and its sensors as data."""

    noise_scale: float  # of the Gamma noise
    offsets: tuple[float, ...]  # of the sensors, (N,)


def transition(x: np.ndarray, k: int) -> np.ndarray:
    """f_k(x), any shape; k is the step that x belongs to."""
    following = x * x
    following += 1.0
    np.divide(25.0, following, out=following)
    following += 0.5
    following *= x
    following += 8.0 * arrays.cos(1.2 * k)
    return following


def gamma_noise(streams: Streams, scale: float, *shape: int) -> np.ndarray:
    """Gamma noise of shape two, (trials, *shape): the sum of two exponentials by inversion."""
    drawn = streams.uniform(2, *shape)
    np.subtract(1.0, drawn, out=drawn)  # in (0, 1], so that the logarithm is finite
    return -scale * arrays.log(drawn[:, 0] * drawn[:, 1])


def level(x: np.ndarray, offset: float) -> np.ndarray:
    """h^i(x), any shape; the offset is s_i."""
    squared = x - offset
    squared *= squared
    squared *= 1 / 20
    return squared
