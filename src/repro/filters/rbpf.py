"""RBPF: particles are loss sequences, each with its Kalman filter (Zhang et al., Algorithm 3)."""

from repro.filters import Filter, _rao_blackwell
from repro.models import Model

LABEL = "RBPF"
SEES = ("received",)


def build(model: Model, settings: dict) -> Filter:
    return _rao_blackwell.build(model, settings, distinct=False)
