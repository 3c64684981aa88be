"""Linear filters of a scalar that is measured by a row out of several, known or unknown.

repro.kernels.linear_filters has their steps.
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from repro.filters import Filter
from repro.kernels import linear_filters as kernels
from repro.models import LinearModel
from repro.network.channels import Seen
from repro.streams import Streams


class Dynamics(NamedTuple):
    """Of one step of X."""

    transition: np.ndarray  # Phi(k), (n, n)
    noise_covariance: np.ndarray  # (n, n)


class System(NamedTuple):
    """A linear system with state X, whose first components are those of the plant."""

    dynamics: Callable[[int], Dynamics]  # of X(k) -> X(k+1)
    mean: np.ndarray  # of X(0), (n,)
    covariance: np.ndarray  # of its error, (n, n)
    second_moment: np.ndarray  # E[X(0) X(0)'], (n, n)
    measurement_variance: float  # of the noise that is added to the measured row of X
    plant_states: int


class State(NamedTuple):
    """What a filter keeps of step k."""

    estimate: np.ndarray  # of X(k), (trials, n)
    covariance: np.ndarray  # of its error, (n, n), or (trials, n, n) if the rows are known
    second_moment: np.ndarray  # E[X(k) X(k)'], (n, n)


def plain(model: LinearModel) -> System:
    """The plant itself."""
    return System(
        lambda k: Dynamics(model.transition_matrix(k), model.process_covariance),
        model.initial_mean,
        model.initial_covariance,
        model.initial_second_moment,
        model.measurement_variance,
        len(model.initial_mean),
    )


def propagated(dynamics: Dynamics, moment: np.ndarray) -> np.ndarray:
    """Phi M Phi' + noise of a symmetric M, (n, n)."""
    out = np.empty(moment.shape)
    kernels.propagated(tuple(dynamics), moment, np.empty(moment.shape), out)
    return out


def unknown_rows(system: System, rows: np.ndarray, weights: np.ndarray, channel: str) -> Filter:
    """The linear minimum mean square error filter where rows[i] measures with weights[i]."""
    n = len(system.mean)

    def init(streams: Streams) -> State:
        mean = np.tile(system.mean, (len(streams), 1))
        return State(mean, system.covariance, system.second_moment)

    def step(state: State, k: int, seen: Seen) -> State:
        after = State(*(np.empty_like(part) for part in state))
        kernels.unknown_row(
            tuple(system.dynamics(k - 1)),
            rows,
            weights,
            system.measurement_variance,
            state.covariance,
            state.second_moment,
            state.estimate,
            np.array(getattr(seen, channel), dtype=float),
            after.covariance,
            after.second_moment,
            after.estimate,
            (np.empty((n, n)), np.empty(n), np.empty(n)),
        )
        return after

    return Filter(
        init,
        step,
        mean=lambda state: state.estimate[:, : system.plant_states],
        variance=lambda state: np.diagonal(state.covariance)[: system.plant_states],
        covariance=lambda state, components: state.covariance[np.ix_(components, components)],
    )


def known_rows(
    system: System,
    rows: np.ndarray,
    which: Callable[[Seen], np.ndarray],
    least_variance: float = 0.0,
) -> Filter:
    """The Kalman filter where the row which(seen), (trials,), measures."""
    n = len(system.mean)

    def init(streams: Streams) -> State:
        mean = np.tile(system.mean, (len(streams), 1))
        return State(mean, np.tile(system.covariance, (len(streams), 1, 1)), system.second_moment)

    def step(state: State, k: int, seen: Seen) -> State:
        after = state._replace(
            estimate=np.empty_like(state.estimate), covariance=np.empty_like(state.covariance)
        )
        kernels.known_row(
            tuple(system.dynamics(k - 1)),
            rows,
            which(seen).astype(np.int64),
            system.measurement_variance,
            least_variance,
            state.covariance,
            state.estimate,
            np.array(seen.received, dtype=float),
            after.covariance,
            after.estimate,
            (np.empty((n, n)), np.empty(n), np.empty(n)),
        )
        return after

    return Filter(
        init,
        step,
        mean=lambda state: state.estimate[:, : system.plant_states],
        variance=lambda state: np.diagonal(state.covariance, axis1=1, axis2=2)[
            :, : system.plant_states
        ],
        covariance=lambda state, components: state.covariance[
            (slice(None), *np.ix_(components, components))
        ],
    )
