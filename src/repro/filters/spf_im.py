"""SPF-IM: the standard particle filter on unimpaired measurements [energy_harvesting Sec. IV]."""

from repro.filters import Filter
from repro.filters.families import ross_eh
from repro.models.sensor_network import SensorNetwork
from repro.parameters.settings import Bootstrap

LABEL = "SPF-IM"
SEES = ("ideal",)
STREAM = ross_eh.STREAM


def build(model: SensorNetwork, settings: Bootstrap) -> Filter:
    return ross_eh.build(model, settings, saturates=False, transmission=None, channel="ideal")
