"""MAPF that takes censored values at face value."""

from repro.filters import Filter
from repro.filters.families import protocol_particles
from repro.models.coupled_targets import CoupledTargets

LABEL = "MAPF-NMC"
SEES = ("received", "group_probability")


def build(model: CoupledTargets, settings: dict) -> Filter:
    return protocol_particles.auxiliary(model, settings, compensated=False)
