"""SPF: the standard particle filter, which knows of neither impairment (Song et al.)."""

from repro.filters import Filter, _ross_eh
from repro.models.sensor_network import SensorNetwork

LABEL = "SPF"
SEES = ("received",)
STREAM = _ross_eh.STREAM


def build(model: SensorNetwork, settings: dict) -> Filter:
    return _ross_eh.build(model, settings, saturates=False, transmission=None)
