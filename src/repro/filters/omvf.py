"""OMVF: the optimal minimum variance filter [packet_delays Theorem 1]."""

from typing import NamedTuple

import numpy as np

from repro.filters import Filter
from repro.filters.families import minimum_variance
from repro.models import LinearModel
from repro.network.packet_delays import mean_weights
from repro.parameters.settings import MinimumVariance

LABEL = "OMVF"
SEES = ("received",)


class State(NamedTuple):
    estimate: np.ndarray  # xh(k|k), (trials, 2)
    covariance: np.ndarray  # P(k|k) that the paper claims, (2, 2): the same for every trial
    second_moment: np.ndarray  # S(k), (2, 2)


def build(model: LinearModel, settings: MinimumVariance) -> Filter:
    """The filter of [packet_delays (6), (13)-(17)]. It sees y(k) and p alone.

    Settings: `alpha_rule` (which weights Lemma 1 gives), `qbar_sign` (+1 as printed).
    """
    bound = model.network.bound
    weights = mean_weights(model.network.arrival_probability, bound, settings.alpha_rule)
    c, q = model.measurement_row, model.process_covariance

    def init(streams):
        return State(
            np.tile(model.initial_mean, (len(streams), 1)),
            model.initial_covariance,
            model.initial_second_moment,
        )

    def step(state, k, seen):
        a = model.transition_matrix(k - 1)
        terms = min(bound, k) + 1  # z(j) = 0 for j < 0: no term of it
        inverses = [np.linalg.inv(model.transition_matrix(k - j)) for j in range(2, terms)]
        update = minimum_variance.gain(
            [c] * terms,
            a,
            inverses,
            weights,
            state.covariance,
            state.second_moment,
            q,
            model.measurement_variance,
            settings.qbar_sign,
        )
        reduced = a - np.outer(update.gain, update.row)  # (13)
        estimate = np.matvec(reduced, state.estimate) + update.gain * seen.received[:, None]  # (6)
        covariance = minimum_variance.covariance_update(
            update, c, a, weights[0], state.covariance, q
        )
        moment = minimum_variance.second_moment_update(a, state.second_moment, q)
        return State(estimate, covariance, moment)

    return Filter(
        init,
        step,
        mean=lambda state: state.estimate,
        variance=lambda state: np.diagonal(state.covariance),
    )
