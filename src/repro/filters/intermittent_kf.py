"""Kalman filter with intermittent observations of Sinopoli et al. (2004).

Compared in [packet_delays Sec. 4.1]. It knows which packets are on time, updates on those and
leaves late packets unused.
"""

from typing import Any

import numpy as np

from repro.filters import Filter
from repro.filters.families.linear_filters import known_rows, plain
from repro.models import LinearModel

LABEL = "[8] Sinopoli"
SEES = ("received", "arrival")


def build(model: LinearModel, settings: dict[str, Any]) -> Filter:
    """The Kalman filter without an update where no packet is on time; no settings."""
    c = model.measurement_row
    rows = np.stack([np.zeros_like(c), c])  # nothing is measured by a packet that is late
    return known_rows(plain(model), rows, which=lambda seen: seen.arrival)
