"""Fast RBPF: one Kalman update for each distinct particle [unknown_losses Algorithm 4]."""

from repro.filters import Filter
from repro.filters.families.rao_blackwell import ColumnPerTriple
from repro.models import Model
from repro.parameters.settings import RaoBlackwell

LABEL = "Fast RBPF"
SEES = ("received",)
STREAM = "rbpf"  # the same random numbers as Algorithm 3


def build(model: Model, settings: RaoBlackwell) -> Filter:
    return ColumnPerTriple(model, settings).filter()
