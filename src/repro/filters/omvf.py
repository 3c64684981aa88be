"""OMVF: the optimal minimum variance filter [packet_delays Theorem 1]."""

from typing import NamedTuple

import numpy as np

from repro.filters import Filter
from repro.filters.families.minimum_variance import known, scratch
from repro.kernels import minimum_variance as kernels
from repro.models import LinearModel
from repro.parameters.settings import MinimumVariance

LABEL = "OMVF"
SEES = ("received",)


class State(NamedTuple):
    estimate: np.ndarray  # xh(k|k), (trials, n)
    covariance: np.ndarray  # P(k|k) that the paper claims, (n, n): the same for every trial
    second_moment: np.ndarray  # S(k), (n, n)


def build(model: LinearModel, settings: MinimumVariance) -> Filter:
    """The filter of [packet_delays (6), (13)-(17)]. It sees y(k) and p alone.

    Settings: `alpha_rule` (which weights Lemma 1 gives), `qbar_sign` (+1 as printed).
    """
    bound, n = model.network.bound, len(model.initial_mean)
    of_network = known(model, model.measurement_variance, settings)

    def init(streams):
        return State(
            np.tile(model.initial_mean, (len(streams), 1)),
            model.initial_covariance,
            model.initial_second_moment,
        )

    def step(state, k, seen):
        terms = min(bound, k) + 1  # z(j) = 0 for j < 0: no term of it
        rows = np.tile(model.measurement_row[:, None], (terms, 1, 1))
        depth = max(terms - 1, 1)
        transitions = np.stack([model.transition_matrix(k - 1 - j) for j in range(depth)])
        after = State(*(np.empty_like(part) for part in state))
        moments = state.covariance, state.second_moment, after.covariance, after.second_moment
        kernels.omvf(
            rows,
            transitions[..., None],
            of_network,
            tuple(moment[..., None] for moment in moments),
            np.empty(1),
            *scratch(terms, n, 1),
            state.estimate,
            np.array(seen.received, dtype=float),
            after.estimate,
        )
        return after

    return Filter(
        init,
        step,
        mean=lambda state: state.estimate,
        variance=lambda state: np.diagonal(state.covariance),
        covariance=lambda state, components: state.covariance[np.ix_(components, components)],
    )
