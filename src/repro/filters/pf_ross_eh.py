"""PF-ROSS-EH: accounts for saturation and for empty batteries [energy_harvesting Algorithm 1]."""

from repro.filters import Filter
from repro.filters.families import ross_eh
from repro.models.sensor_network import SensorNetwork
from repro.parameters.settings import Bootstrap

LABEL = "PF-ROSS-EH"
SEES = ("received",)
STREAM = ross_eh.STREAM


def build(model: SensorNetwork, settings: Bootstrap) -> Filter:
    return ross_eh.build(model, settings, saturates=True, transmission="lemma1")
