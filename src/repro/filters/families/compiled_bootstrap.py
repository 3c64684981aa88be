"""The bootstrap filter of [energy_harvesting Algorithm 1] by compiled kernels."""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from repro.filters import Filter
from repro.kernels import arrays, compiled_resampling
from repro.kernels import sensor_network_step as kernels
from repro.models.rss import SignalStrength
from repro.models.sensor_network import ExponentialNoise, GaussianNoise, SensorNetwork
from repro.models.ungm import Growth
from repro.network.saturation import Saturation
from repro.parameters.settings import Bootstrap
from repro.streams import Streams

UNREACHED = 1e300  # the saturation level of a sensor without one
SCHEMES = {"systematic": kernels.SYSTEMATIC, "multinomial": kernels.MULTINOMIAL}


class Cloud(NamedTuple):
    """Weighted particles of each trial, and what is estimated from them."""

    particles: np.ndarray  # (trials, n, particles)
    weights: np.ndarray  # (trials, particles), each row sums to one
    mean: np.ndarray  # sum of w x, (trials, n)
    degenerate: np.ndarray  # updates so far that no particle explained, (trials,)
    keys: np.ndarray  # of the trials' random numbers, (trials,)


def covers(model: SensorNetwork) -> bool:
    """Whether there are kernels for a model."""
    known = isinstance(model.noise, GaussianNoise | ExponentialNoise)
    return model.plant is not None and known


def build(
    model: SensorNetwork,
    settings: Bootstrap,
    transmission: np.ndarray,
    saturation: Saturation | None,
    channel: str,
) -> Filter:
    """Weighs by the likelihood (27) with lambda(k) = transmission[k]; no saturation is gbar = 0."""
    scheme, in_logarithms = SCHEMES[settings.resampling], settings.weights == "logarithmic"
    probability, limit = (0.0, UNREACHED) if saturation is None else saturation
    noise, count = _noise(model), settings.particles
    drawn = kernels.drawn_length(len(model.initial_mean), count)
    advance = _advance(model.plant)

    def init(streams: Streams) -> Cloud:
        particles = np.ascontiguousarray(model.draw_prior(streams, count))
        weights = np.full((len(streams), count), 1.0 / count)
        mean = np.empty(particles.shape[:2])
        kernels.weighted_means(particles, weights, mean)
        return Cloud(particles, weights, mean, np.zeros(len(streams)), streams.keys())

    def step(cloud: Cloud, k: int, seen: Any) -> Cloud:
        z = np.array(getattr(seen, channel), dtype=float, order="C")
        after = Cloud(
            np.empty_like(cloud.particles),
            np.empty_like(cloud.weights),
            np.empty_like(cloud.mean),
            cloud.degenerate.copy(),
            cloud.keys,
        )
        network = float(transmission[k]), float(probability), float(limit)
        known = noise, network, scheme, in_logarithms
        scratch = np.empty(count, dtype=np.int64), np.empty(drawn), np.empty((z.shape[1], count))
        clouds = cloud.particles, cloud.weights, *after[:4]
        advance(k, (cloud.keys, k, z), (*known, *clouds, *scratch))
        return after

    def diagnostics(cloud: Cloud) -> dict[str, np.ndarray]:
        sizes = np.empty(len(cloud.weights))
        compiled_resampling.effective_sample_sizes(cloud.weights, sizes)
        return {"effective_sample_size": sizes}

    return Filter(
        init,
        step,
        mean=lambda cloud: cloud.mean,
        degenerate=lambda cloud: cloud.degenerate,
        diagnostics=diagnostics,
    )


def _noise(model: SensorNetwork) -> np.ndarray:
    """As the kernels have it, (N + 1,)."""
    if isinstance(model.noise, GaussianNoise):
        return np.append(model.noise.measurement_variances, model.noise.channel_variance)
    assert isinstance(model.noise, ExponentialNoise)
    return np.append(np.full(model.sensors, model.noise.mean), 0.0)


def _advance(plant: Growth | SignalStrength | None) -> Callable:
    """Step of the plant: calls its kernel with what is the plant's between the other arguments."""
    if isinstance(plant, Growth):
        offsets = np.array(plant.offsets, dtype=float)

        def advance(k, first, rest):
            drive = 8.0 * arrays.cos(1.2 * (k - 1))
            kernels.growth(*first, drive, float(plant.noise_scale), offsets, *rest)

        return advance
    assert isinstance(plant, SignalStrength)
    slope = -5.0 * plant.exponent / arrays.log(10.0)
    at_one = plant.power + 10.0 * plant.exponent * arrays.log10(plant.reference)
    time, root = float(plant.time), np.array(plant.root, order="C")
    sensors = np.array(plant.sensors, dtype=float, order="C")

    def advance(k, first, rest):
        kernels.signal_strength(*first, time, root, sensors, at_one, slope, *rest)

    return advance
