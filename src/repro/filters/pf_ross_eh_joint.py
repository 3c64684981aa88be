"""PF-ROSS-EH, Rao-Blackwellised over battery and harvest: the exact model, which (13) is not.

Whether a sensor transmits is correlated in time, so that z(k) is not independent of earlier
measurements given x(k). Each particle carries Pr{E(k), H(k) | x(0..k), Z(1..k)} of each sensor.
"""

from typing import NamedTuple

import numpy as np

from repro.filters import Filter
from repro.filters.families import particle_filter, ross_eh
from repro.models.sensor_network import SensorNetwork
from repro.network.energy_harvesting import initial_joint, joint_chain, joint_transition
from repro.parameters.settings import JointBootstrap

LABEL = "PF-ROSS-EH, joint"
SEES = ("received",)
STREAM = ross_eh.STREAM


class State(NamedTuple):
    cloud: particle_filter.Cloud
    belief: np.ndarray  # law of (E, H) by sensor and particle, (trials, sensors, pairs, particles)


def build(model: SensorNetwork, settings: JointBootstrap) -> Filter:
    """Settings: `particles`, `resampling`."""
    chain, start = joint_transition(model.energy), initial_joint(model.energy)
    visited = joint_chain(model.energy, model.steps).any(axis=0).ravel()  # others never happen
    chain, start = chain[np.ix_(visited, visited)], start[visited]
    empty = np.nonzero(visited)[0] < len(model.energy.harvest_transition)  # E = 0

    def init(streams):
        particles = model.draw_prior(streams, settings.particles)
        shape = (len(streams), model.sensors, len(start), settings.particles)
        belief = np.broadcast_to(start[:, None], shape)
        return State(particle_filter.equally_weighted(particles, streams), belief)

    def step(state, k, seen):
        cloud, z = state.cloud, seen.received
        chosen = particle_filter.parents(cloud.weights, cloud.streams, settings.resampling)
        particles = model.move(particle_filter.taken(cloud.particles, chosen), k, cloud.streams)
        belief = np.take_along_axis(state.belief, chosen[:, None, None, :], axis=-1)
        belief = chain.T @ belief
        total = np.zeros(chosen.shape)
        for i in range(model.sensors):
            level = model.level(particles, i)
            sent = model.noise.log_likelihood(z[:, i], level, i, model.saturation, transmission=1.0)
            lost = model.noise.log_channel(z[:, i])[:, None]
            largest = np.maximum(sent, lost)
            likelihood = np.where(
                empty[:, None], np.exp(lost - largest)[:, None], np.exp(sent - largest)[:, None]
            )
            updated = belief[:, i] * likelihood
            given = updated.sum(axis=1)  # p(z^i | x(0..k), Z(1..k-1)), scaled
            explained = given > 0
            with np.errstate(divide="ignore"):
                total += np.log(given) + largest
            updated /= np.where(explained, given, 1.0)[:, None]
            belief[:, i] = np.where(explained[:, None], updated, belief[:, i])
        return State(particle_filter.weighted(particles, total, cloud), belief)

    return Filter(
        init,
        step,
        mean=lambda state: state.cloud.mean,
        degenerate=lambda state: state.cloud.degenerate,
    )
