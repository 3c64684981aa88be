"""MAPF-NMC: takes censored values at face value [censored_network Sec. IV]."""

from repro.filters import Filter
from repro.filters.families import protocol_particles
from repro.models.coupled_targets import CoupledTargets
from repro.parameters.settings import ProtocolParticles

LABEL = "MAPF-NMC"
SEES = ("received", "group_probability")


def build(model: CoupledTargets, settings: ProtocolParticles) -> Filter:
    return protocol_particles.auxiliary(model, settings, compensated=False)
