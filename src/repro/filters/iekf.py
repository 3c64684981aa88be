"""Extended Kalman filter that knows which packets are on time and updates on those alone."""

from typing import Any

from repro.filters import Filter
from repro.filters.families import extended_kalman
from repro.models import Model

LABEL = "EKF, arrivals known"
SEES = ("received", "arrival")


def build(model: Model, settings: dict[str, Any]) -> Filter:
    return extended_kalman.build(model, lambda seen, evidence, last: (seen.arrival, None))
