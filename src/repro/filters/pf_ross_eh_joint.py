"""PF-ROSS-EH, Rao-Blackwellised over battery and harvest: it follows the model exactly.

The likelihood [energy_harvesting (13)] takes z(k) as independent of earlier measurements given
x(k). It is not, as transmissions are correlated in time. Here each particle carries
Pr{E(k), H(k) | x(0..k), Z(1..k)} of each sensor.
"""

from typing import NamedTuple

import numpy as np

from repro.filters import Filter
from repro.filters.families import particle_filter, ross_eh
from repro.models.sensor_network import SensorNetwork
from repro.network.channels import Seen
from repro.network.energy_harvesting import initial_joint, joint_chain, joint_transition
from repro.parameters.settings import JointBootstrap
from repro.streams import Streams

LABEL = "PF-ROSS-EH, joint"
SEES = ("received",)
STREAM = ross_eh.STREAM


class State(NamedTuple):
    cloud: particle_filter.Cloud
    belief: np.ndarray  # law of (E, H) by sensor and particle, (trials, sensors, pairs, particles)


def build(model: SensorNetwork, settings: JointBootstrap) -> Filter:
    """The bootstrap filter, with a law of (E, H) for each sensor and particle."""
    assert model.energy is not None  # the study has batteries
    chain, start = joint_transition(model.energy), initial_joint(model.energy)
    # Pairs that never occur are left out.
    visited = joint_chain(model.energy, model.steps).any(axis=0).ravel()
    chain, start = chain[np.ix_(visited, visited)], start[visited]
    empty = np.nonzero(visited)[0] < len(model.energy.harvest_transition)  # E = 0

    def init(streams: Streams) -> State:
        particles = model.draw_prior(streams, settings.particles)
        shape = (len(streams), model.sensors, len(start), settings.particles)
        belief = np.broadcast_to(start[:, None], shape)
        return State(particle_filter.equally_weighted(particles, streams), belief)

    def step(state: State, k: int, seen: Seen) -> State:
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
