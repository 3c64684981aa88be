"""What OMVF and EMVF hand to their kernels, repro.kernels.minimum_variance."""

from typing import Any

import numpy as np

from repro.models import LinearModel, Model
from repro.models.sparse import Rows
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


def scratch(terms: int, n: int, systems: int) -> tuple[Any, ...]:
    """The gain, the rows J_i and J, and room for the work on them."""
    room = np.empty((n, n, systems)), np.empty((n + 1, systems)), np.empty(systems)
    return np.empty((n, systems)), np.empty((terms + 1, n, systems)), (*room, np.empty((n, n + 1)))


def component_major(jacobian: Rows | np.ndarray, shape: tuple[int, int, int]) -> np.ndarray:
    """A Jacobian as the kernels have it, (rows, n, systems)."""
    if isinstance(jacobian, np.ndarray):
        systems_last = jacobian[..., None] if jacobian.ndim == 2 else np.moveaxis(jacobian, 0, -1)
        return np.array(np.broadcast_to(systems_last, shape), dtype=float, order="C")
    matrix = np.zeros(shape)
    for i, row in enumerate(jacobian):
        for j, entry in row.items():
            matrix[i, j] = entry
    return matrix
