"""Protocol-based particle filters for a complex network [censored_network Algorithm 1].

The nodes' filters run in lockstep: each takes the others' estimates of step k, never of step
k + 1, as the known input of its coupling. The paper's filters differ in three arguments: whether
the coupling is drawn, whether the likelihood accounts for the censoring, and whether particles are
chosen with the new measurement (auxiliary) or without it (bootstrap).
"""

from typing import Any, Literal, NamedTuple

import numpy as np

from repro.filters import Filter
from repro.filters.families import censored_likelihood, particle_filter
from repro.models.coupled_targets import CoupledTargets, drift, pull
from repro.parameters.settings import ProtocolParticles
from repro.streams import Streams


class Draws(NamedTuple):
    """The random draws of a filter: its prior, and the mixture [censored_network (12)]."""

    model: CoupledTargets
    particles: int  # D
    coupled: bool  # False (NC) drops the coupling but draws the same random numbers
    drawn_per: Literal["particle", "step"]  # "step": one Bernoulli variable for all particles

    def initial(self, streams: Streams) -> np.ndarray:
        """Particles of the prior, (trials, nodes, 3, D)."""
        mean = self.model.initial_mean.reshape(-1, 3)
        root = np.diag(self.model.initial_deviation)
        return particle_filter.gaussian(streams, mean, root, self.particles)

    def drift(self, particles: np.ndarray, k: int) -> np.ndarray:
        """f(x) of every particle."""
        return drift(particles, self.model.speed, self.model.turn_rate)

    def transition(self, particles: np.ndarray, cloud: particle_filter.Cloud, k: int) -> np.ndarray:
        """A draw of (12) for each particle."""
        return self.mixture(self.drift(particles, k), cloud, k)

    def mixture(self, moved: np.ndarray, cloud: particle_filter.Cloud, k: int) -> np.ndarray:
        """A draw of (12) from f(x) (trials, nodes, 3, D), coupled to the estimates of step k."""
        _, nodes, components, count = moved.shape
        drawn = particle_filter.standard_normal(cloud.streams, nodes, components, count)
        drawn *= self.model.process_deviation[:, None]
        drawn += moved
        draws = count if self.drawn_per == "particle" else 1
        on = cloud.streams.uniform(nodes, draws) < self.model.coupling_rate
        if self.coupled:
            push = pull(cloud.mean, self.model.coupling)
            drawn += on[:, :, None] * push[..., None]
        return drawn


def auxiliary(
    model: CoupledTargets,
    settings: ProtocolParticles,
    coupled: bool = True,
    compensated: bool = True,
) -> Filter:
    """[censored_network Algorithm 1] with the weights (22)."""
    draws = _draws(model, settings, coupled)
    return particle_filter.auxiliary(
        draws.initial,
        draws.drift,
        draws.mixture,
        censored_likelihood.build(model, compensated),
        settings.resampling,
    )


def bootstrap(model: CoupledTargets, settings: ProtocolParticles) -> Filter:
    """The same draws and likelihood with standard resampling."""
    draws = _draws(model, settings)
    return particle_filter.bootstrap(
        draws.initial,
        draws.transition,
        censored_likelihood.build(model),
        settings.resampling,
    )


def dead_reckoning(model: CoupledTargets, settings: ProtocolParticles) -> Filter:
    """The same draws without a measurement."""
    draws = _draws(model, settings)

    def init(streams: Streams) -> particle_filter.Cloud:
        return particle_filter.equally_weighted(draws.initial(streams), streams)

    def step(cloud: particle_filter.Cloud, k: int, seen: Any) -> particle_filter.Cloud:
        particles = draws.transition(cloud.particles, cloud, k)
        return cloud._replace(particles=particles, mean=particles.mean(axis=-1))

    return particle_filter.as_filter(init, step)


def _draws(model: CoupledTargets, settings: ProtocolParticles, coupled: bool = True) -> Draws:
    return Draws(model, settings.particles, coupled, settings.coupling_drawn_per)
