"""The best filter of the form [packet_delays (6)]: what the OMVF would be if it were optimal.

Not in the paper. F and K are the regression of x(k+1) on (xh(k), y(k+1)) with exact second
moments; no filter of that form has a smaller mean square error at the next step.
"""

from typing import Any, NamedTuple

import numpy as np

from repro.filters import Filter
from repro.filters.families import second_moments
from repro.models import LinearModel

LABEL = "best of form (6)"
SEES = ("received",)
NOTHING_NEW = 1e-12  # share of a regressor's variance below which the others determine it


class State(NamedTuple):
    estimate: np.ndarray  # (trials, n)
    moment: np.ndarray  # second moment of [X(k), xh(k)], square, the same for every trial


def regression(model: LinearModel, moment: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """F (n, n) and K (n,) that minimise the error of x(k+1), from the moment of [X(k+1), xh(k)]."""
    n = len(model.initial_mean)
    cross, power = second_moments.with_measurement(model, moment)
    size = len(moment) - n
    equations = np.empty((n + 1, 2 * n + 1))  # of the regressors xh and y, and x on the right
    equations[:n, :n] = moment[size:, size:]
    equations[:n, n] = equations[n, :n] = cross[size:]
    equations[n, n] = power
    equations[:n, n + 1 :] = moment[size:, :n]
    equations[n, n + 1 :] = cross[:n]
    own = np.diagonal(equations).copy()
    for i, variance in enumerate(own):  # Gauss and Jordan
        if equations[i, i] <= NOTHING_NEW * variance:  # xh has no variance yet at the first steps
            equations[i] = 0.0
            continue
        row = equations[i] / equations[i, i]
        equations -= equations[:, i, None] * row
        equations[i] = row
    coefficients = equations[:, n + 1 :].T
    return coefficients[:, :n], coefficients[:, n]


def build(model: LinearModel, settings: dict[str, Any]) -> Filter:
    """xh(k+1) = F xh(k) + K y(k+1) with F and K of `regression`; no settings."""
    n = len(model.initial_mean)

    def init(streams):
        return State(
            np.tile(model.initial_mean, (len(streams), 1)),
            second_moments.initial(model, model.initial_second_moment),
        )

    def step(state, k, seen):
        moment = second_moments.predict(model, state.moment, k - 1)
        transfer, gain = regression(model, moment)
        estimate = (transfer * state.estimate[:, None, :]).sum(axis=-1)
        estimate += gain * seen.received[:, None]
        return State(estimate, second_moments.update(model, moment, transfer, gain))

    return Filter(
        init,
        step,
        mean=lambda state: state.estimate,
        variance=lambda state: np.diagonal(second_moments.mean_square_error(state.moment, n)),
        covariance=lambda state, components: second_moments.mean_square_error(state.moment, n)[
            np.ix_(components, components)
        ],
    )
