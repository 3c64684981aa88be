"""EMVF: the enhanced minimum variance filter [packet_delays Theorem 2]."""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from repro.filters import Filter
from repro.filters.families.minimum_variance import component_major, known, scratch
from repro.kernels import minimum_variance as kernels
from repro.models import Model
from repro.parameters.settings import ExtendedMinimumVariance

LABEL = "EMVF"
SEES = ("received",)


class State(NamedTuple):
    estimate: np.ndarray  # xh(k|k), (n, trials)
    covariance: np.ndarray  # P(k|k), (n, n, trials)
    second_moment: np.ndarray  # S(k), (n, n, trials)
    predictions: tuple[np.ndarray, ...]  # xh(k|k-1), xh(k-1|k-2), ..., (trials, n), at most N
    transitions: np.ndarray  # f'(k-1), f'(k-2), ..., (N or 1, n, n, trials)
    degenerate: np.ndarray  # updates skipped because their gain was not finite, (trials,)


def build(model: Model, settings: ExtendedMinimumVariance) -> Filter:
    """The filter of [packet_delays (22)-(27)]. It sees y(k) and p alone.

    Settings: `initial_second_moment` (theorem_2, P0, matched), `alpha_rule`, `qbar_sign`, and
    `late_measurement` (h of a late packet at the sensor of its own step, or at the current one).
    """
    return build_with(model, settings, realised_delay=None)


def build_with(
    model: Model,
    settings: ExtendedMinimumVariance,
    realised_delay: Callable[[Any], np.ndarray] | None,
) -> Filter:
    """The filter with the innovation of (22), weighted by the means alpha_i.

    `realised_delay(seen)`, if given, returns delays (trials,) whose indicators are the weights
    instead.
    """
    bound, n = model.network.bound, len(model.initial_mean)
    matched = settings.initial_second_moment == "matched"
    of_network = known(model, model.measurement_covariance[0, 0], settings, matched)
    weights = of_network[0]

    def initial_second_moment():
        if settings.initial_second_moment == "P0":
            return model.initial_covariance  # as printed in Sec. 4.2.2
        mean = model.initial_mean
        return model.initial_covariance + np.outer(mean, mean)  # Assumption 2, Theorem 2

    def init(streams):
        trials = len(streams)

        def of_each(values):
            return np.repeat(np.array(values, dtype=float)[..., None], trials, axis=-1)

        estimate = of_each(model.initial_mean)
        return State(
            estimate,
            of_each(model.initial_covariance),
            of_each(initial_second_moment()),
            (estimate.T,)[:bound],
            np.zeros((max(bound, 1), n, n, trials)),
            np.zeros(trials),
        )

    def step(state, k, seen):
        trials = len(state.degenerate)
        transitions = np.empty_like(state.transitions)
        jacobian = model.transition_jacobian(state.estimate.T, k - 1)
        transitions[0] = component_major(jacobian, (n, n, trials))
        transitions[1:] = state.transitions[:-1]
        predicted = model.transition(state.estimate.T, k - 1)  # (23)
        predictions = (predicted, *state.predictions)
        sensors = (seen.sensor, *seen.earlier_sensors)[: len(predictions)]
        if settings.late_measurement == "current sensor":
            sensors = (seen.sensor,) * len(predictions)
        terms = list(zip(predictions, sensors, strict=True))
        rows = [
            component_major(model.measurement_jacobian(x, sensor), (1, n, trials))
            for x, sensor in terms
        ]
        ranges = np.stack([model.measurement(x, sensor)[:, 0] for x, sensor in terms])
        alpha = weights[: len(ranges), None]
        indicators = alpha
        if realised_delay is not None:
            indicators = realised_delay(seen) == np.arange(len(ranges))[:, None]
        after = State(
            np.empty_like(state.estimate),
            np.empty_like(state.covariance),
            np.empty_like(state.second_moment),
            predictions[:bound],
            transitions,
            state.degenerate.copy(),
        )
        kernels.emvf(
            np.concatenate(rows),
            transitions,
            of_network,
            (state.covariance, state.second_moment, after.covariance, after.second_moment),
            spread_of_ranges(alpha, ranges),
            *scratch(len(ranges), n, trials),
            np.ascontiguousarray(predicted.T),
            seen.received - (indicators * ranges).sum(axis=0),
            after.estimate,
            after.degenerate,
        )
        return after

    def predict(state, k):
        return model.transition(state.estimate.T, k - 1)

    return Filter(
        init,
        step,
        mean=lambda state: state.estimate.T,
        predicted=predict,
        degenerate=lambda state: state.degenerate,
        covariance=lambda state, components: np.moveaxis(
            state.covariance[np.ix_(components, components)], -1, 0
        ),
    )


def spread_of_ranges(weights: np.ndarray, ranges: np.ndarray) -> np.ndarray:
    """Variance of h over the delays, (trials,), from weights and ranges (delays, trials) in m.

    It does not depend on the origin of coordinates: the setting `matched`, not in the paper.
    """
    return (weights * ranges**2).sum(axis=0) - (weights * ranges).sum(axis=0) ** 2
