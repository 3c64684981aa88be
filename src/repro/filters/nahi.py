"""The filter for uncertain observations of Nahi (1969), compared in [packet_delays Sec. 4.1].

It has a channel of its own: y(k) = z(k) with probability p, and noise alone otherwise.
"""

from typing import Any, NamedTuple

import numpy as np

from repro.filters import Filter
from repro.filters.families.minimum_variance import quadratic, second_moment_update
from repro.models import LinearModel

LABEL = "[2] Nahi"
SEES = ("uncertain",)


class State(NamedTuple):
    estimate: np.ndarray  # (trials, n)
    covariance: np.ndarray  # (n, n), the same for every trial
    second_moment: np.ndarray  # S(k) = E[x(k) x(k)']


def build(model: LinearModel, settings: dict[str, Any]) -> Filter:
    """The linear MMSE filter of that channel; no settings."""
    p = model.network.arrival_probability
    c, q = model.measurement_row, model.process_covariance

    def init(streams):
        return State(
            np.tile(model.initial_mean, (len(streams), 1)),
            model.initial_covariance,
            model.initial_second_moment,
        )

    def step(state, k, seen):
        a = model.transition_matrix(k - 1)
        predicted = np.matvec(a, state.estimate)
        covariance = a @ state.covariance @ a.T + q
        moment = second_moment_update(a, state.second_moment, q)
        variance = (
            p**2 * quadratic(c, covariance)
            + p * (1 - p) * quadratic(c, moment)
            + model.measurement_variance
        )
        gain = p * covariance @ c / variance
        innovation = seen.uncertain - p * np.vecdot(predicted, c)
        return State(
            predicted + gain * innovation[:, None],
            covariance - variance * np.outer(gain, gain),
            moment,
        )

    return Filter(
        init,
        step,
        mean=lambda state: state.estimate,
        variance=lambda state: np.diagonal(state.covariance),
    )
