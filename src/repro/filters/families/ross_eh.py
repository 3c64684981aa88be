"""Particle filtering with saturating, energy-harvesting sensors (Song et al., Algorithm 1).

One bootstrap kernel; the filters differ in which of the two impairments they allow for, and in
what they take for the transmission probability.
"""

import numpy as np

from repro.filters import Filter
from repro.filters.families import compiled_bootstrap, particle_filter
from repro.models.sensor_network import SensorNetwork
from repro.network.energy_harvesting import transmission_probability
from repro.parameters.settings import Bootstrap

STREAM = "bootstrap"  # shared by the filters of this kernel: they are compared on the same draws


def build(
    model: SensorNetwork,
    settings: Bootstrap,
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

    saturation = model.saturation if saturates else None
    if compiled_bootstrap.covers(model):
        return compiled_bootstrap.build(model, settings, probability, saturation, channel)

    def move(particles, cloud, k):
        return model.move(particles, k, cloud.streams)

    def log_likelihood(particles, seen, k):
        z = getattr(seen, channel)
        total = np.zeros((len(z), particles.shape[-1]))
        for i in range(model.sensors):  # (13), (27)
            level = model.level(particles, i)
            total += model.noise.log_likelihood(z[:, i], level, i, saturation, probability[k])
        if settings.weights == "linear":
            with np.errstate(divide="ignore"):  # log 0 = -inf is meant
                total = np.log(np.exp(total))
        return total

    return particle_filter.bootstrap(
        lambda streams: model.draw_prior(streams, settings.particles),
        move,
        log_likelihood,
        settings.resampling,
    )
