"""Dead reckoning: the particles of MAPF without any measurement. The paper does not have it."""

from repro.filters import Filter
from repro.filters.families import protocol_particles
from repro.models.coupled_targets import CoupledTargets
from repro.parameters.settings import ProtocolParticles

LABEL = "dead reckoning"
SEES = ()


def build(model: CoupledTargets, settings: ProtocolParticles) -> Filter:
    return protocol_particles.dead_reckoning(model, settings)
