"""Protocol-based particle filters for a complex network (Song et al., Algorithm 1).

The node filters run in lockstep: each uses the estimates of step k of the others as the known
input of its coupling, and never one of step k + 1. The differences between the paper's filters
are arguments: whether the coupling is drawn, whether the censoring is compensated, and whether
particles are chosen with the new measurement (auxiliary) or without (bootstrap).
"""

from typing import NamedTuple

import numpy as np

from repro.filters import Filter
from repro.filters.families import censored_likelihood, particle_filter
from repro.models.coupled_targets import CoupledTargets, drift, pull
from repro.parameters.settings import ProtocolParticles


class Draws(NamedTuple):
    """The draws of a filter: its prior, and the mixture (12)."""

    model: CoupledTargets
    particles: int  # D
    coupled: bool  # False is NC: the coupling is dropped, the stream is used all the same
    bernoulli: str  # "particle": one a particle and draw; "step": one for all particles of a draw

    def initial(self, streams) -> np.ndarray:
        mean = self.model.initial_mean.reshape(-1, 3)
        root = np.diag(self.model.initial_deviation)
        return particle_filter.gaussian(streams, mean, root, self.particles)

    def drift(self, particles: np.ndarray, k: int) -> np.ndarray:
        return drift(particles, self.model.speed, self.model.turn_rate)

    def transition(self, particles: np.ndarray, cloud: particle_filter.Cloud, k: int) -> np.ndarray:
        return self.mixture(self.drift(particles, k), cloud, k)

    def mixture(self, moved: np.ndarray, cloud: particle_filter.Cloud, k: int) -> np.ndarray:
        """A draw of (12) from f(x) (trials, nodes, 3, D), coupled to the estimates of step k."""
        _, nodes, components, count = moved.shape
        drawn = particle_filter.standard_normal(cloud.streams, nodes, components, count)
        drawn *= self.model.process_deviation[:, None]
        drawn += moved
        draws = count if self.bernoulli == "particle" else 1
        on = cloud.streams.uniform(nodes, draws) < self.model.coupling_rate
        if self.coupled:
            push = pull(cloud.mean, self.model.coupling)
            drawn += on[:, :, None] * push[..., None]
        return drawn


def auxiliary(
    model: CoupledTargets, settings: ProtocolParticles, coupled=True, compensated=True
) -> Filter:
    """Algorithm 1; weights (22)."""
    draws = _draws(model, settings, coupled)
    return particle_filter.auxiliary(
        draws.initial,
        draws.drift,
        draws.mixture,
        censored_likelihood.build(model, compensated),
        settings.resampling,
    )


def bootstrap(model: CoupledTargets, settings: ProtocolParticles) -> Filter:
    """The same draws and likelihood in the standard resampling framework."""
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

    def init(streams):
        return particle_filter.equally_weighted(draws.initial(streams), streams)

    def step(cloud, k, seen):
        particles = draws.transition(cloud.particles, cloud, k)
        return cloud._replace(particles=particles, mean=particles.mean(axis=-1))

    return particle_filter.as_filter(init, step)


def _draws(model: CoupledTargets, settings: ProtocolParticles, coupled: bool = True) -> Draws:
    return Draws(model, settings.particles, coupled, settings.coupling_drawn_per)
