"""A plant seen by N noisy sensors over noisy channels [energy_harvesting (1), (2), (7)].

Particles are (trials, n, particles), so that each component is contiguous.
"""

import math
from collections.abc import Callable
from typing import NamedTuple, Protocol

import numpy as np

from repro.models.rss import SignalStrength
from repro.models.ungm import Growth
from repro.network.energy_harvesting import EnergyQueue
from repro.network.saturation import Saturation
from repro.streams import Streams

# exp(-700) adds nothing to one; below it exp is ten times slower, as its result underflows.
EXPONENT_FLOOR = -700.0


# (streams, particles) -> (trials, n, particles) from p(x(0))
DrawPrior = Callable[[Streams, int], np.ndarray]
# (x(k-1), k, streams) -> x(k) from p(x(k)|x(k-1)); may overwrite its argument
Move = Callable[[np.ndarray, int, Streams], np.ndarray]
# (x, i) -> h^i(x), (trials, particles); i counts the sensors from 0
Level = Callable[[np.ndarray, int], np.ndarray]


class Noise(Protocol):
    """The noises nu of the sensors and n of the channels, and what a filter needs of them."""

    def draw(self, streams: Streams, steps: int) -> tuple[np.ndarray, np.ndarray]:
        """nu and n, (trials, N, steps) each."""
        ...

    def log_channel(self, z: np.ndarray) -> np.ndarray:
        """log density of n."""
        ...

    def log_likelihood(
        self,
        z: np.ndarray,
        level: np.ndarray,
        i: int,
        saturation: Saturation | None,
        transmission: float,
    ) -> np.ndarray:
        """log p(z^i | x), (trials, particles), from z (trials,) and levels h^i(x) (15)."""
        ...


class SensorNetwork(NamedTuple):
    """What a filter knows of plant, sensors, noises and network."""

    initial_mean: np.ndarray  # (n,)
    sensors: int
    steps: int
    draw_prior: DrawPrior
    move: Move
    level: Level
    noise: Noise
    saturation: Saturation | None = None  # None: nothing saturates
    energy: EnergyQueue | None = None  # None: the sensors always transmit
    plant: Growth | SignalStrength | None = None  # `move` and `level` as data, for kernels


class GaussianNoise(NamedTuple):
    """nu^i ~ N(0, measurement_variances[i]) at the sensors, n^i ~ N(0, channel_variance)."""

    measurement_variances: np.ndarray  # (N,)
    channel_variance: float

    def draw(self, streams: Streams, steps: int) -> tuple[np.ndarray, np.ndarray]:
        """nu and n, (trials, N, steps) each, drawn sensor by sensor, so that any N share draws."""
        drawn = streams.standard_normal(len(self.measurement_variances), 2, steps)
        nu = np.sqrt(self.measurement_variances)[:, None] * drawn[:, :, 0]
        return nu, np.sqrt(self.channel_variance) * drawn[:, :, 1]

    def log_channel(self, z: np.ndarray) -> np.ndarray:
        """log density of n."""
        return _squares(z.copy(), self.channel_variance) + _log_peak(self.channel_variance)

    def log_likelihood(
        self,
        z: np.ndarray,
        level: np.ndarray,
        i: int,
        saturation: Saturation | None,
        transmission: float,
    ) -> np.ndarray:
        """log p(z^i | x), (trials, particles), from z (trials,) and levels h^i(x) (15).

        Without saturation gbar = 0. In logarithms, as p_n(z) underflows. Beyond the saturation
        level Sat(h), and with it its term, is the same for all particles of a trial; elsewhere
        Sat(h) = h and the two terms of (20) are equal.
        """
        variance = self.measurement_variances[i] + self.channel_variance  # of nu + n (28)
        shared = _log(transmission) + _log_peak(variance)
        lost = _log(1.0 - transmission) - shared + self.log_channel(z)
        sent, other = _squares(z[:, None] - level, variance), lost[:, None]
        if saturation is not None:
            clear, clipped = _log(1.0 - saturation.probability), _log(saturation.probability)
            for limit in (-saturation.level, saturation.level):
                beyond = level < limit if limit < 0 else level > limit
                if beyond.any():  # else nothing would change
                    at_limit = clipped + _squares(z - limit, variance)
                    other = np.where(beyond, np.logaddexp(lost, at_limit)[:, None], other)
                    sent += np.where(beyond, clear, 0.0)
        if saturation is not None or transmission < 1.0:
            sent = _log_add(sent, other)
        sent += shared
        return sent


class ExponentialNoise(NamedTuple):
    """nu^i and n^i exponential with the same mean, so that their sum is Erlang of shape two."""

    mean: float
    sensors: int

    def draw(self, streams: Streams, steps: int) -> tuple[np.ndarray, np.ndarray]:
        """nu and n, (trials, N, steps) each."""
        drawn = -self.mean * np.log1p(-streams.uniform(self.sensors, 2, steps))
        return drawn[:, :, 0], drawn[:, :, 1]

    def _sum(self, error: np.ndarray, factor: float) -> np.ndarray:
        """The factor times the density of nu^i + n^i, the convolution (28); overwrites error."""
        np.maximum(error, 0.0, out=error)
        decay = error * (-1 / self.mean)
        np.exp(decay, out=decay)
        decay *= error
        decay *= factor / self.mean**2
        return decay

    def log_channel(self, z: np.ndarray) -> np.ndarray:
        """log density of n; -inf where z < 0."""
        return np.where(z >= 0, -z / self.mean - np.log(self.mean), -np.inf)

    def log_likelihood(
        self,
        z: np.ndarray,
        level: np.ndarray,
        i: int,
        saturation: Saturation | None,
        transmission: float,
    ) -> np.ndarray:
        """log p(z^i | x), (trials, particles), from z (trials,) and levels h^i(x) (15).

        Without saturation gbar = 0; beyond its level Sat(h) is the same for all particles. The
        densities are at least exp(-z / mean) where they are positive, so that they can be summed
        without logarithms. The result is -inf where x cannot have led to z.
        """
        z = z[:, None]
        sent = self._sum(z - level, transmission)
        if saturation is not None:
            for limit in (-saturation.level, saturation.level):
                beyond = level < limit if limit < 0 else level > limit
                if beyond.any():  # else nothing would change
                    at_limit = self._sum(z - limit, transmission * saturation.probability)
                    mixed = sent * (1.0 - saturation.probability)
                    mixed += at_limit
                    sent = np.where(beyond, mixed, sent)
        if transmission < 1.0:
            sent += (1.0 - transmission) * np.exp(self.log_channel(z))
        with np.errstate(divide="ignore"):  # log 0 = -inf is intended
            return np.log(sent, out=sent)


def _squares(error: np.ndarray, variance: float) -> np.ndarray:
    """-error^2 / (2 variance), written over error."""
    error *= error
    error *= -0.5 / variance
    return error


def _log_peak(variance: float) -> float:
    return -0.5 * math.log(2 * math.pi * variance)


def _log(probability: float) -> float:
    return math.log(probability) if probability > 0 else -math.inf


def _log_add(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """log(exp(first) + exp(second)), ten times faster than numpy.logaddexp.

    Where the second is not finite, the first must be.
    """
    largest = np.maximum(first, second)
    rest = np.minimum(first, second)
    rest -= largest
    np.maximum(rest, EXPONENT_FLOOR, out=rest)
    np.exp(rest, out=rest)
    np.log1p(rest, out=rest)
    largest += rest
    return largest
