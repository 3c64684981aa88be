"""Particle filtering with saturating, energy-harvesting sensors (Song et al., Algorithm 1).

One bootstrap kernel; the filters differ in which of the two impairments they allow for, and in
what they take for the transmission probability.
"""

import numpy as np

from repro.filters import Filter, _particles
from repro.models.sensor_network import SensorNetwork
from repro.network.energy_harvesting import transmission_probability
from repro.network.saturation import saturated

STREAM = "bootstrap"  # shared by the filters of this kernel: they are compared on the same draws


def log_sent(model: SensorNetwork, x: np.ndarray, z: np.ndarray, i: int, saturates: bool):
    """log p(z^i | x, sent), (20), (trials, particles); z of (trials,)."""
    level, z = model.level(x, i), z[:, None]
    probability = model.saturation.probability if saturates else 0.0
    error = z - level
    if probability == 0.0:
        return model.noise.log_sum(error, i)
    clear = model.noise.log_sum(error, i)
    error = z - saturated(level, model.saturation.level)
    clipped = model.noise.log_sum(error, i)
    clipped += np.log(probability)
    if probability == 1.0:
        return clipped
    clear += np.log1p(-probability)
    return np.logaddexp(clear, clipped, out=clear)


def log_received(log_sent: np.ndarray, log_lost: np.ndarray, transmission: float | np.ndarray):
    """log p(z^i | x) of (15), written over log_sent; log_lost = log p_n(z^i), (trials, 1)."""
    if np.ndim(transmission) == 0 and transmission == 1.0:
        return log_sent
    log_sent += np.log(transmission)
    return np.logaddexp(log_sent, log_lost + np.log1p(-transmission), out=log_sent)


def build(
    model: SensorNetwork,
    settings: dict,
    saturates: bool,
    transmission: str | None,
    channel: str = "received",
) -> Filter:
    """Algorithm 1 with the likelihood (27) as far as the filter knows of the impairments.

    `saturates`: allows for saturation (else gbar = 0). `transmission`: the rule of lambda(k),
    `lemma1` or `exact`; None takes every measurement as sent (lambda = 1).
    Settings: `particles`; `resampling`, systematic or multinomial; `weights`, logarithmic or
    linear (what underflows is zero).
    """
    if transmission is None:
        probability = np.ones(model.steps + 1)
    else:
        probability = transmission_probability(model.energy, model.steps, transmission)

    def move(particles, cloud, k):
        return model.move(particles, k, cloud.streams)

    def log_likelihood(particles, seen, k):
        z = getattr(seen, channel)
        total = np.zeros((len(z), particles.shape[-1]))
        with np.errstate(divide="ignore", invalid="raise"):  # log 0 = -inf is meant
            for i in range(model.sensors):  # (13), (27)
                sent = log_sent(model, particles, z[:, i], i, saturates)
                lost = model.noise.log_channel(z[:, i])[:, None]
                total += log_received(sent, lost, probability[k])
            if settings["weights"] == "linear":
                total = np.log(np.exp(total))
        return total

    return _particles.bootstrap(
        lambda streams: model.draw_prior(streams, settings["particles"]),
        move,
        log_likelihood,
        settings["resampling"],
    )
