"""The filter for uncertain observations of Nahi (1969), compared in [packet_delays Sec. 4.1].

It has a channel of its own: y(k) = z(k) with probability p, and noise alone otherwise.
"""

from typing import Any

import numpy as np

from repro.filters import Filter
from repro.filters.families.linear_filters import plain, unknown_rows
from repro.models import LinearModel

LABEL = "[2] Nahi"
SEES = ("uncertain",)


def build(model: LinearModel, settings: dict[str, Any]) -> Filter:
    """The linear MMSE filter of that channel; no settings."""
    p, c = model.network.arrival_probability, model.measurement_row
    rows, weights = np.stack([c, np.zeros_like(c)]), np.array([p, 1.0 - p])
    return unknown_rows(plain(model), rows, weights, "uncertain")
