"""Particle filters for saturating, energy-harvesting sensors [energy_harvesting Algorithm 1].

All are one bootstrap filter. They differ in which of the two impairments they account for, and in
the transmission probability that they assume.
"""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from repro.filters import Filter
from repro.filters.families.clouds import weighted_covariance
from repro.kernels import arrays, resampling
from repro.kernels import sensor_network_step as kernels
from repro.kernels.resampling import SCHEMES
from repro.models.rss import SignalStrength
from repro.models.sensor_network import ExponentialNoise, SensorNetwork
from repro.models.ungm import Growth
from repro.network.energy_harvesting import TransmissionRule, transmission_probability
from repro.network.saturation import Saturation
from repro.parameters.settings import Bootstrap
from repro.streams import Streams

STREAM = "bootstrap"  # shared by the filters of this family: they are compared on the same draws
UNREACHED = 1e300  # the saturation level of a sensor without one


class Cloud(NamedTuple):
    """Weighted particles of each trial, and what is estimated from them."""

    particles: np.ndarray  # (trials, n, particles)
    weights: np.ndarray  # (trials, particles), each row sums to one
    mean: np.ndarray  # sum of w x, (trials, n)
    degenerate: np.ndarray  # updates so far that no particle explained, (trials,)
    keys: np.ndarray  # of the trials' random numbers, (trials,)


def build(
    model: SensorNetwork,
    settings: Bootstrap,
    saturates: bool,
    transmission: TransmissionRule | None,
    channel: str = "received",
) -> Filter:
    """Algorithm 1 with the likelihood (27) of the impairments that the filter accounts for.

    `saturates`: whether it accounts for saturation (else gbar = 0). `transmission`: the rule for
    lambda(k), `lemma1` or `exact`; None takes every measurement as sent (lambda = 1). `channel`:
    the measurements that it filters. With linear weights, a likelihood that underflows is zero.
    """
    if transmission is None or model.energy is None:
        probability = np.ones(model.steps + 1)
    else:
        probability = transmission_probability(model.energy, model.steps, transmission)
    saturation = model.saturation if saturates else None
    scheme, in_logarithms = SCHEMES[settings.resampling], settings.weights == "logarithmic"
    noise, plant, count = noises(model), plant_at(model.plant), settings.particles
    kernel = kernels.growth if isinstance(model.plant, Growth) else kernels.signal_strength

    def init(streams: Streams) -> Cloud:
        return prior(model, streams, count)

    def step(cloud: Cloud, k: int, seen: Any) -> Cloud:
        z = np.array(getattr(seen, channel), dtype=float, order="C")
        after = Cloud(
            np.empty_like(cloud.particles),
            np.empty_like(cloud.weights),
            np.empty_like(cloud.mean),
            cloud.degenerate.copy(),
            cloud.keys,
        )
        known = noise, network(probability[k], saturation), scheme, in_logarithms
        scratch = *drawn(model, count), np.empty((z.shape[1], count))
        clouds = cloud.particles, cloud.weights, *after[:4]
        kernel(cloud.keys, k, z, *plant(k), *known, *clouds, *scratch)
        return after

    def covariance(cloud: Cloud, components: Sequence[int]) -> np.ndarray:
        return weighted_covariance(cloud.particles, cloud.weights, cloud.mean, components)

    def diagnostics(cloud: Cloud) -> dict[str, np.ndarray]:
        sizes = np.empty(len(cloud.weights))
        resampling.effective_sample_sizes(cloud.weights, sizes)
        return {"effective_sample_size": sizes}

    return Filter(
        init,
        step,
        mean=lambda cloud: cloud.mean,
        degenerate=lambda cloud: cloud.degenerate,
        diagnostics=diagnostics,
        covariance=covariance,
    )


def prior(model: SensorNetwork, streams: Streams, count: int) -> Cloud:
    """The particles before the first measurement."""
    particles = np.ascontiguousarray(model.draw_prior(streams, count))
    weights = np.full((len(streams), count), 1.0 / count)
    mean = np.empty(particles.shape[:2])
    resampling.weighted_means(particles, weights, mean)
    return Cloud(particles, weights, mean, np.zeros(len(streams)), streams.keys())


def drawn(model: SensorNetwork, count: int) -> tuple[np.ndarray, np.ndarray]:
    """Room for a trial's parents and random numbers."""
    length = kernels.drawn_length(len(model.initial_mean), count)
    return np.empty(count, dtype=np.int64), np.empty(length)


def network(transmission: float, saturation: Saturation | None) -> tuple[float, float, float]:
    """As the kernels have it; without saturation gbar = 0."""
    probability, limit = (0.0, UNREACHED) if saturation is None else saturation
    return float(transmission), float(probability), float(limit)


def noises(model: SensorNetwork) -> np.ndarray:
    """As the kernels have them, (N + 1,)."""
    if isinstance(model.noise, ExponentialNoise):
        return np.append(np.full(model.sensors, model.noise.mean), 0.0)
    return np.append(model.noise.measurement_variances, model.noise.channel_variance)


def plant_at(plant: Growth | SignalStrength) -> Callable[[int], tuple]:
    """What a kernel needs to know of the plant at step k."""
    if isinstance(plant, Growth):
        scale, offsets = float(plant.noise_scale), np.array(plant.offsets, dtype=float)
        return lambda k: (8.0 * arrays.cos(1.2 * (k - 1)), scale, offsets)
    at_one = plant.power + 10.0 * plant.exponent * arrays.log10(plant.reference)
    slope = -5.0 * plant.exponent / arrays.log(10.0)
    root, sensors = (np.array(part, dtype=float, order="C") for part in (plant.root, plant.sensors))
    known = float(plant.time), root, sensors, at_one, slope
    return lambda k: known
