"""RBPF: particles are loss sequences, each with its Kalman filter [unknown_losses Algorithm 3]."""

from repro.filters import Filter
from repro.filters.families import rao_blackwell
from repro.models import Model
from repro.parameters.settings import RaoBlackwell

LABEL = "RBPF"
SEES = ("received",)


def build(model: Model, settings: RaoBlackwell) -> Filter:
    return rao_blackwell.build(model, settings, rao_blackwell.column_per_particle)
