"""Kalman filter that knows every delay: no filter of this network has a smaller error.

Not in [packet_delays]. With D(k) known the augmented problem is linear and Gaussian, so that the
Kalman filter is exact.
"""

from typing import Any, NamedTuple

import numpy as np

from repro.filters import Filter
from repro.filters.families.delay_augmentation import augment, initial_mean, initial_moment
from repro.models import LinearModel

LABEL = "genie (knows delays)"
SEES = ("received", "delay")
ALREADY_KNOWN = 1e-9  # relative variance below which z(k-D) has been received before


class State(NamedTuple):
    estimate: np.ndarray  # of X(k), (trials, n + N + 1)
    covariance: np.ndarray  # (trials, n + N + 1, n + N + 1)


def build(model: LinearModel, settings: dict[str, Any]) -> Filter:
    """The Kalman filter on the augmented state X(k); no settings."""
    n = len(model.initial_mean)

    def init(streams):
        trials = len(streams)
        return State(
            np.tile(initial_mean(model), (trials, 1)),
            np.tile(initial_moment(model, model.initial_covariance), (trials, 1, 1)),
        )

    def step(state, k, seen):
        phi, noise = augment(model, k - 1)
        predicted = np.matvec(phi, state.estimate)
        covariance = phi @ state.covariance @ phi.T + noise
        trials = np.arange(len(predicted))
        received = n + seen.delay.astype(int)  # entry of X that y(k) is
        cross = covariance[trials, :, received]
        variance = covariance[trials, received, received]
        fresh = variance > ALREADY_KNOWN * model.measurement_variance
        gain = np.where(fresh, 1 / np.where(fresh, variance, 1.0), 0.0)[:, None] * cross
        innovation = seen.received - predicted[trials, received]
        return State(
            predicted + gain * innovation[:, None],
            covariance - gain[:, :, None] * cross[:, None, :],
        )

    return Filter(
        init,
        step,
        mean=lambda state: state.estimate[:, :n],
        variance=lambda state: np.diagonal(state.covariance, axis1=-2, axis2=-1)[:, :n],
    )
