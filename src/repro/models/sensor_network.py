"""A plant seen by N noisy sensors over noisy channels (Song et al., (1), (2), (7)).

Particles are (trials, n, particles), so that each component is contiguous.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from repro.streams import Streams


class SensorNetwork(NamedTuple):
    """What a filter knows of plant, sensors, noises and network."""

    initial_mean: np.ndarray  # (n,)
    sensors: int
    steps: int
    draw_prior: Callable  # (streams, particles) -> (trials, n, particles) from p(x(0))
    move: Callable  # (x(k-1), k, streams) -> x(k) ~ p(x(k)|x(k-1)); may overwrite its argument
    level: Callable  # (x, i) -> h^i(x) of sensor i, (trials, particles)
    noise: Any  # GaussianNoise or ExponentialNoise
    saturation: Any = None  # network.saturation.Saturation
    energy: Any = None  # network.energy_harvesting.EnergyQueue


class GaussianNoise(NamedTuple):
    """nu^i ~ N(0, measurement_variances[i]) at the sensors, n^i ~ N(0, channel_variance)."""

    measurement_variances: np.ndarray  # (N,)
    channel_variance: float

    def draw(self, streams: Streams, steps: int) -> tuple[np.ndarray, np.ndarray]:
        """nu and n, (trials, N, steps) each; drawn sensor by sensor: N shares with N + 1."""
        drawn = streams.standard_normal(len(self.measurement_variances), 2, steps)
        nu = np.sqrt(self.measurement_variances)[:, None] * drawn[:, :, 0]
        return nu, np.sqrt(self.channel_variance) * drawn[:, :, 1]

    def log_sum(self, error: np.ndarray, i: int) -> np.ndarray:
        """log density of nu^i + n^i (28), written over `error`."""
        return _log_normal(error, self.measurement_variances[i] + self.channel_variance)

    def log_channel(self, z: np.ndarray) -> np.ndarray:
        """log density of n."""
        return _log_normal(z.copy(), self.channel_variance)


class ExponentialNoise(NamedTuple):
    """nu^i and n^i exponential with the same mean, so that their sum is Erlang of shape two."""

    mean: float
    sensors: int

    def draw(self, streams: Streams, steps: int) -> tuple[np.ndarray, np.ndarray]:
        """nu and n, (trials, N, steps) each."""
        drawn = -self.mean * np.log1p(-streams.uniform(self.sensors, 2, steps))
        return drawn[:, :, 0], drawn[:, :, 1]

    def log_sum(self, error: np.ndarray, i: int) -> np.ndarray:
        """log density of nu^i + n^i (28), written over `error`; -inf where error <= 0."""
        error *= 1 / self.mean
        positive = np.maximum(error, 0.0)
        np.log(positive, out=positive)
        np.subtract(positive, error, out=error)
        error -= np.log(self.mean)
        return error

    def log_channel(self, z: np.ndarray) -> np.ndarray:
        """log density of n; -inf where z < 0."""
        return np.where(z >= 0, -z / self.mean - np.log(self.mean), -np.inf)


def _log_normal(value: np.ndarray, variance: float) -> np.ndarray:
    value *= value
    value *= -0.5 / variance
    value -= 0.5 * np.log(2 * np.pi * variance)
    return value
