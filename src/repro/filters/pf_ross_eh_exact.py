"""PF-ROSS-EH with the exact transmission probability, from the chain of (E, H), not Lemma 1."""

from repro.filters import Filter
from repro.filters.families import ross_eh
from repro.models.sensor_network import SensorNetwork
from repro.parameters.settings import Bootstrap

LABEL = "PF-ROSS-EH, exact λ"
SEES = ("received",)
STREAM = ross_eh.STREAM


def build(model: SensorNetwork, settings: Bootstrap) -> Filter:
    return ross_eh.build(model, settings, saturates=True, transmission="exact")
