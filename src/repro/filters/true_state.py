"""No filter: the true state itself, to see what a controller does without any estimation error."""

from typing import Any

import numpy as np

from repro.filters import Filter
from repro.models import Model

LABEL = "true state"
SEES = ("truth",)


def build(model: Model, settings: dict[str, Any]) -> Filter:
    return Filter(
        init=lambda streams: np.tile(model.initial_mean, (len(streams), 1)),
        step=lambda state, k, seen: seen.truth,
        mean=lambda state: state,
    )
