"""The linear minimum variance estimator of Sun (2009), compared in [packet_delays Sec. 4.1].

That paper does not print its equations. The linear minimum mean square error (LMMSE) estimate of
x(k) from y(1) ... y(k) is unique, so it is computed here exactly, by augmentation with random rows.
"""

from typing import Any

from repro.filters import Filter
from repro.filters.families.delay_augmentation import augmented, entries
from repro.filters.families.linear_filters import unknown_rows
from repro.models import LinearModel
from repro.network.packet_delays import mean_weights

LABEL = "[21] Sun (exact LMMSE)"
SEES = ("received",)


def build(model: LinearModel, settings: dict[str, Any]) -> Filter:
    """The exact LMMSE filter on the augmented state X(k); no settings."""
    weights = mean_weights(model.network.arrival_probability, model.network.bound)
    return unknown_rows(augmented(model), entries(model), weights, "received")
