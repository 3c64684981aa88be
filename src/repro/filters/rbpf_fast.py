"""Fast RBPF: one Kalman update for each distinct particle [unknown_losses Algorithm 4]."""

from repro.filters import Filter
from repro.filters.families import rao_blackwell
from repro.models import Model
from repro.parameters.settings import RaoBlackwell

LABEL = "Fast RBPF"
SEES = ("received",)
STREAM = "rbpf"  # the same random numbers as Algorithm 3


def build(model: Model, settings: RaoBlackwell) -> Filter:
    built = rao_blackwell.build(model, settings, rao_blackwell.column_per_triple)
    # About a quarter of the particles, or fewer, are distinct and have a Kalman filter
    distinct = max(1, settings.particles // 4)
    return built._replace(diagnostics=rao_blackwell.triples, particles=distinct)
