"""Kalman filter that knows every delay: no filter of this network has a smaller error.

Not in [packet_delays]. With D(k) known the augmented problem is linear and Gaussian, so that the
Kalman filter is exact.
"""

from typing import Any

from repro.filters import Filter
from repro.filters.families.delay_augmentation import augmented, entries
from repro.filters.families.linear_filters import known_rows
from repro.models import LinearModel

LABEL = "genie (knows delays)"
SEES = ("received", "delay")
ALREADY_KNOWN = 1e-9  # relative variance below which z(k-D) has been received before


def build(model: LinearModel, settings: dict[str, Any]) -> Filter:
    """The Kalman filter on the augmented state X(k); no settings."""
    return known_rows(
        augmented(model),
        entries(model),
        which=lambda seen: seen.delay,
        least_variance=ALREADY_KNOWN * model.measurement_variance,
    )
