"""The linear minimum variance estimator of Sun (2009), compared in [packet_delays Sec. 4.1].

That paper does not print its equations. The linear minimum mean square error (LMMSE) estimate of
x(k) from y(1) ... y(k) is unique, so it is computed here exactly, by augmentation with random rows.
"""

from typing import Any, NamedTuple

import numpy as np

from repro.filters import Filter
from repro.filters.families.delay_augmentation import augment, initial_mean, initial_moment
from repro.models import LinearModel
from repro.network.packet_delays import mean_weights

LABEL = "[21] Sun (exact LMMSE)"
SEES = ("received",)


class State(NamedTuple):
    estimate: np.ndarray  # of X(k), (trials, n + N + 1)
    covariance: np.ndarray  # of its error, (n + N + 1, n + N + 1), the same for every trial
    second_moment: np.ndarray  # E[X(k) X(k)'], of the same shape as the covariance


def build(model: LinearModel, settings: dict[str, Any]) -> Filter:
    """The exact LMMSE filter on the augmented state X(k); no settings."""
    n = len(model.initial_mean)
    weights = mean_weights(model.network.arrival_probability, model.network.bound)
    mean_row = np.concatenate([np.zeros(n), weights])

    def init(streams):
        return State(
            np.tile(initial_mean(model), (len(streams), 1)),
            initial_moment(model, model.initial_covariance),
            initial_moment(model, model.initial_second_moment),
        )

    def step(state, k, seen):
        phi, noise = augment(model, k - 1)
        predicted = np.matvec(phi, state.estimate)
        covariance = phi @ state.covariance @ phi.T + noise
        moment = phi @ state.second_moment @ phi.T + noise
        # y = h X with a white random row h, one of the last N + 1 unit rows.
        spread = weights @ np.diagonal(moment)[n:] - mean_row @ moment @ mean_row
        cross = covariance @ mean_row
        gain = cross / (mean_row @ cross + spread)
        innovation = seen.received - np.vecdot(predicted, mean_row)
        return State(
            predicted + gain * innovation[:, None],
            covariance - np.outer(gain, cross),
            moment,
        )

    return Filter(
        init,
        step,
        mean=lambda state: state.estimate[:, :n],
        variance=lambda state: np.diagonal(state.covariance)[:n],
    )
