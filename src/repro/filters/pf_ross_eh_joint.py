"""PF-ROSS-EH, Rao-Blackwellised over battery and harvest: it follows the model exactly.

The likelihood [energy_harvesting (13)] takes z(k) as independent of earlier measurements given
x(k). It is not, as transmissions are correlated in time. Here each particle carries
Pr{E(k), H(k) | x(0..k), Z(1..k)} of each sensor.
"""

from typing import NamedTuple

import numpy as np

from repro.filters import Filter
from repro.filters.families import ross_eh
from repro.filters.families.clouds import weighted_covariance
from repro.kernels import joint_energy_step as kernels
from repro.kernels.resampling import SCHEMES
from repro.models.sensor_network import SensorNetwork
from repro.models.ungm import Growth
from repro.network.channels import Seen
from repro.network.energy_harvesting import initial_joint, joint_chain, joint_transition
from repro.parameters.settings import JointBootstrap
from repro.streams import Streams

LABEL = "PF-ROSS-EH, joint"
SEES = ("received",)
STREAM = ross_eh.STREAM


class State(NamedTuple):
    particles: np.ndarray  # (trials, n, particles)
    weights: np.ndarray  # (trials, particles), each row sums to one
    laws: np.ndarray  # of (E, H) by sensor and particle, (trials, sensors, pairs, particles)
    mean: np.ndarray  # sum of w x, (trials, n)
    degenerate: np.ndarray  # updates so far that no particle explained, (trials,)
    keys: np.ndarray  # of the trials' random numbers, (trials,)


def build(model: SensorNetwork, settings: JointBootstrap) -> Filter:
    """The bootstrap filter, with a law of (E, H) for each sensor and particle."""
    assert model.energy is not None  # the study has batteries
    chain, start = joint_transition(model.energy), initial_joint(model.energy)
    # Pairs that never occur are left out.
    visited = joint_chain(model.energy, model.steps).any(axis=0).ravel()
    chain, start = chain[np.ix_(visited, visited)], start[visited]
    empty = np.nonzero(visited)[0] < len(model.energy.harvest_transition)  # E = 0
    noise, network = ross_eh.noises(model), ross_eh.network(1.0, model.saturation)
    scheme, plant = SCHEMES[settings.resampling], ross_eh.plant_at(model.plant)
    kernel = kernels.growth if isinstance(model.plant, Growth) else kernels.signal_strength
    count = settings.particles

    def init(streams: Streams) -> State:
        shape = (len(streams), model.sensors, len(start), count)
        laws = np.broadcast_to(start[:, None], shape).copy()
        first = ross_eh.prior(model, streams, count)
        return State(first.particles, first.weights, laws, *first[2:])

    def step(state: State, k: int, seen: Seen) -> State:
        z = np.array(seen.received, dtype=float, order="C")
        after = State(
            np.empty_like(state.particles),
            np.empty_like(state.weights),
            np.empty_like(state.laws),
            np.empty_like(state.mean),
            state.degenerate.copy(),
            state.keys,
        )
        known = plant(k), noise, network, (chain, empty), scheme
        rows = np.empty((model.sensors + len(start) + kernels.ROWS, count))
        scratch = *ross_eh.drawn(model, count), rows
        kernel(state.keys, k, z, *known, state[:4], after[:5], scratch)
        return after

    return Filter(
        init,
        step,
        mean=lambda state: state.mean,
        degenerate=lambda state: state.degenerate,
        covariance=lambda state, components: weighted_covariance(
            state.particles, state.weights, state.mean, components
        ),
    )
