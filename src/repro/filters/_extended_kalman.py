"""Extended Kalman filter with a scalar measurement, updating where a flag says so."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from repro.filters import Filter
from repro.models import Model


class State(NamedTuple):
    estimate: np.ndarray  # xh(k|k), (trials, n)
    covariance: np.ndarray  # P(k|k), (trials, n, n)


def build(model: Model, uses: Callable) -> Filter:
    """`uses(seen)` gives 1 where the received value is taken for z(k) and 0 where it is left."""
    q, r = model.process_covariance, model.measurement_variance

    def init(streams):
        trials = len(streams)
        return State(
            np.tile(model.initial_mean, (trials, 1)),
            np.tile(model.initial_covariance, (trials, 1, 1)),
        )

    def step(state, k, seen):
        jacobian = model.transition_jacobian(state.estimate, k - 1)
        predicted = model.transition(state.estimate, k - 1)
        covariance = jacobian @ state.covariance @ np.swapaxes(jacobian, -1, -2) + q
        row = model.measurement_jacobian(predicted, seen.sensor)
        cross = np.matvec(covariance, row)
        variance = np.vecdot(cross, row) + r
        gain = (uses(seen) / variance)[:, None] * cross
        innovation = seen.received - model.measurement(predicted, seen.sensor)
        covariance = covariance - gain[:, :, None] * cross[:, None, :]
        return State(
            predicted + gain * innovation[:, None],
            (covariance + np.swapaxes(covariance, -1, -2)) / 2,
        )

    return Filter(
        init,
        step,
        mean=lambda state: state.estimate,
        predicted=lambda state, k: model.transition(state.estimate, k - 1),
    )
