"""RBPF: particles are loss sequences, each with its Kalman filter (Zhang et al., Algorithm 3)."""

from repro.filters import Filter
from repro.filters.families import rao_blackwell
from repro.models import Model

LABEL = "RBPF"
SEES = ("received",)


def build(model: Model, settings: dict) -> Filter:
    return rao_blackwell.build(model, settings, distinct=False)
