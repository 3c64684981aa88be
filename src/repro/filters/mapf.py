"""MAPF, the modified auxiliary particle filter [censored_network Algorithm 1]."""

from repro.filters import Filter
from repro.filters.families import protocol_particles
from repro.models.coupled_targets import CoupledTargets
from repro.parameters.settings import ProtocolParticles

LABEL = "MAPF"
SEES = ("received", "code", "group_probability")


def build(model: CoupledTargets, settings: ProtocolParticles) -> Filter:
    return protocol_particles.auxiliary(model, settings)
