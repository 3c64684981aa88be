"""What OMVF and EMVF hand to their kernels, repro.kernels.minimum_variance."""

from typing import Any

import numpy as np

from repro.models import LinearModel, Model
from repro.network.packet_delays import mean_weights
from repro.parameters.settings import MinimumVariance


def known(
    model: LinearModel | Model,
    measurement_variance: float,
    settings: MinimumVariance,
    matched: bool = False,
) -> tuple[Any, ...]:
    """What a filter knows of plant and network."""
    network = model.network
    return (
        mean_weights(network.arrival_probability, network.bound, settings.alpha_rule),
        float(settings.qbar_sign),
        np.array(model.process_covariance, dtype=float),
        float(measurement_variance),
        matched,
    )


def scratch(terms: int, n: int) -> tuple[Any, ...]:
    """The gain, the rows J_i and J, and room for the work on them."""
    return np.empty(n), np.empty((terms + 1, n)), (np.empty((n, n)), np.empty((n, n + 1)))
