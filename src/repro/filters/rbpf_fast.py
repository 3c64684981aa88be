"""Fast RBPF: one Kalman update for each distinct particle (Zhang, You, Xie 2018, Algorithm 4)."""

from repro.filters import Filter
from repro.filters.families import rao_blackwell
from repro.models import Model
from repro.parameters.settings import RaoBlackwell

LABEL = "Fast RBPF"
SEES = ("received",)
STREAM = "rbpf"  # the same random numbers as Algorithm 3


def build(model: Model, settings: RaoBlackwell) -> Filter:
    return rao_blackwell.build(model, settings, distinct=True)
