"""Extended Kalman filter that weighs each measurement by what it knows or infers of its loss."""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from repro.filters import Filter, _kalman
from repro.models import Model


class State(NamedTuple):
    estimate: np.ndarray  # xh(k|k), (n, trials)
    covariance: np.ndarray  # Sigma(k|k), packed, (n (n + 1) / 2, trials)


def build(model: Model, uses: Callable) -> Filter:
    """`uses(seen)` gives 1 where the received value is taken for z(k) and 0 where it is left."""
    n, m = len(model.initial_mean), len(model.measurement_covariance)

    def init(streams):
        return State(*_kalman.start(model, (len(streams),)))

    def step(state, k, seen):
        estimate, covariance = _kalman.predict(model, *state, k - 1)
        received = seen.received.reshape(-1, m)
        innovation = _kalman.innovate(model, estimate, covariance, received, seen.sensor)
        return State(*_kalman.correct(estimate, covariance, innovation, uses(seen)))

    return Filter(
        init,
        step,
        mean=lambda state: state.estimate.T,
        predicted=lambda state, k: model.transition(state.estimate.T, k - 1),
        variance=lambda state: _kalman.diagonal(state.covariance, n).T,
    )
