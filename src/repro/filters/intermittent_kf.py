"""Kalman filter with intermittent observations of Sinopoli et al. (2004).

Compared in [packet_delays Sec. 4.1]. It knows which packets are on time, updates on those and
leaves late packets unused.
"""

from typing import Any, NamedTuple

import numpy as np

from repro.filters import Filter
from repro.models import LinearModel

LABEL = "[8] Sinopoli"
SEES = ("received", "arrival")


class State(NamedTuple):
    estimate: np.ndarray  # (trials, n)
    covariance: np.ndarray  # (trials, n, n): it depends on the arrivals


def build(model: LinearModel, settings: dict[str, Any]) -> Filter:
    """The Kalman filter without an update where no packet is on time; no settings."""
    c, q = model.measurement_row, model.process_covariance

    def init(streams):
        trials = len(streams)
        return State(
            np.tile(model.initial_mean, (trials, 1)),
            np.tile(model.initial_covariance, (trials, 1, 1)),
        )

    def step(state, k, seen):
        a = model.transition_matrix(k - 1)
        predicted = np.matvec(a, state.estimate)
        covariance = a @ state.covariance @ a.T + q
        cross = np.matvec(covariance, c)
        variance = np.vecdot(cross, c) + model.measurement_variance
        gain = (seen.arrival / variance)[:, None] * cross
        innovation = seen.received - np.vecdot(predicted, c)
        return State(
            predicted + gain * innovation[:, None],
            covariance - gain[:, :, None] * cross[:, None, :],
        )

    return Filter(
        init,
        step,
        mean=lambda state: state.estimate,
        variance=lambda state: np.diagonal(state.covariance, axis1=-2, axis2=-1),
    )
