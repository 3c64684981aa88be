"""A plant seen by N noisy sensors over noisy channels [energy_harvesting (1), (2), (7)]."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from repro.kernels import arrays
from repro.models.rss import SignalStrength
from repro.models.ungm import Growth
from repro.network.energy_harvesting import EnergyQueue
from repro.network.saturation import Saturation
from repro.streams import Streams

# (streams, particles) -> (trials, n, particles) from p(x(0))
DrawPrior = Callable[[Streams, int], np.ndarray]


class GaussianNoise(NamedTuple):
    """nu^i ~ N(0, measurement_variances[i]) at the sensors, n^i ~ N(0, channel_variance)."""

    measurement_variances: np.ndarray  # (N,)
    channel_variance: float

    def draw(self, streams: Streams, steps: int) -> tuple[np.ndarray, np.ndarray]:
        """nu and n, (trials, N, steps) each, drawn sensor by sensor, so that any N share draws."""
        drawn = streams.standard_normal(len(self.measurement_variances), 2, steps)
        nu = np.sqrt(self.measurement_variances)[:, None] * drawn[:, :, 0]
        return nu, np.sqrt(self.channel_variance) * drawn[:, :, 1]


class ExponentialNoise(NamedTuple):
    """nu^i and n^i exponential with the same mean, so that their sum is Erlang of shape two."""

    mean: float
    sensors: int

    def draw(self, streams: Streams, steps: int) -> tuple[np.ndarray, np.ndarray]:
        """nu and n, (trials, N, steps) each."""
        drawn = -self.mean * arrays.log1p(-streams.uniform(self.sensors, 2, steps))
        return drawn[:, :, 0], drawn[:, :, 1]


Noise = GaussianNoise | ExponentialNoise  # nu of the sensors and n of the channels


class SensorNetwork(NamedTuple):
    """What a filter knows of plant, sensors, noises and network."""

    initial_mean: np.ndarray  # (n,)
    sensors: int
    steps: int
    draw_prior: DrawPrior
    plant: Growth | SignalStrength
    noise: Noise
    saturation: Saturation | None = None  # None: nothing saturates
    energy: EnergyQueue | None = None  # None: the sensors always transmit
