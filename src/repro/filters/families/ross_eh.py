"""Particle filters for saturating, energy-harvesting sensors [energy_harvesting Algorithm 1].

All are one bootstrap filter. They differ in which of the two impairments they account for, and in
the transmission probability that they assume.
"""

import numpy as np

from repro.filters import Filter
from repro.filters.families import compiled_bootstrap, particle_filter
from repro.models.sensor_network import SensorNetwork
from repro.network.energy_harvesting import TransmissionRule, transmission_probability
from repro.parameters.settings import Bootstrap

STREAM = "bootstrap"  # shared by the filters of this family: they are compared on the same draws


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
    if compiled_bootstrap.covers(model):
        return compiled_bootstrap.build(model, settings, probability, saturation, channel)

    def move(particles, cloud, k):
        return model.move(particles, k, cloud.streams)

    def log_likelihood(particles, seen, k):
        z = getattr(seen, channel)
        total, sends = np.zeros((len(z), particles.shape[-1])), float(probability[k])
        for i in range(model.sensors):  # (13), (27)
            level = model.level(particles, i)
            total += model.noise.log_likelihood(z[:, i], level, i, saturation, sends)
        if settings.weights == "linear":
            with np.errstate(divide="ignore"):  # log 0 = -inf is intended
                total = np.log(np.exp(total))
        return total

    return particle_filter.bootstrap(
        lambda streams: model.draw_prior(streams, settings.particles),
        move,
        log_likelihood,
        settings.resampling,
    )
