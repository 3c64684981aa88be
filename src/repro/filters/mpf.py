"""MPF: the draws and the likelihood of MAPF with standard resampling [censored_network Sec. IV]."""

from repro.filters import Filter
from repro.filters.families import protocol_particles
from repro.models.coupled_targets import CoupledTargets
from repro.parameters.settings import ProtocolParticles

LABEL = "MPF"
SEES = ("received", "code", "group_probability")


def build(model: CoupledTargets, settings: ProtocolParticles) -> Filter:
    return protocol_particles.bootstrap(model, settings)
