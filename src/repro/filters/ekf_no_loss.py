"""Extended Kalman filter on measurements without losses: the bound that the paper compares with."""

from typing import Any

from repro.filters import Filter
from repro.filters.families import extended_kalman
from repro.models import Model

LABEL = "EKF, no losses"
SEES = ("without_loss",)


def build(model: Model, settings: dict[str, Any]) -> Filter:
    return extended_kalman.build(
        model, lambda seen, evidence, last: (1.0, None), channel="without_loss"
    )
