"""EMVF: the enhanced minimum variance filter [packet_delays Theorem 2]."""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from repro.filters import Filter
from repro.filters.families import minimum_variance
from repro.models import Model
from repro.models.sparse import dense
from repro.network.packet_delays import mean_weights
from repro.parameters.settings import ExtendedMinimumVariance

LABEL = "EMVF"
SEES = ("received",)


class State(NamedTuple):
    estimate: np.ndarray  # xh(k|k), (trials, n)
    covariance: np.ndarray  # P(k|k), (trials, n, n)
    second_moment: np.ndarray  # S(k), (trials, n, n)
    predictions: tuple[np.ndarray, ...]  # xh(k|k-1), xh(k-1|k-2), ..., at most N
    inverses: tuple[np.ndarray, ...]  # f'(k-1)^-1, f'(k-2)^-1, ..., at most N - 1
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
    bound = model.network.bound
    weights = mean_weights(model.network.arrival_probability, bound, settings.alpha_rule)
    matched = settings.initial_second_moment == "matched"
    q, r = model.process_covariance, model.measurement_covariance[0, 0]

    def initial_second_moment():
        if settings.initial_second_moment == "P0":
            return model.initial_covariance  # as printed in Sec. 4.2.2
        mean = model.initial_mean
        return model.initial_covariance + np.outer(mean, mean)  # Assumption 2, Theorem 2

    def init(streams):
        trials = len(streams)
        return State(
            np.tile(model.initial_mean, (trials, 1)),
            np.tile(model.initial_covariance, (trials, 1, 1)),
            np.tile(initial_second_moment(), (trials, 1, 1)),
            (np.tile(model.initial_mean, (trials, 1)),)[:bound],
            (),
            np.zeros(trials),
        )

    def innovation_weights(seen, ranges):
        if realised_delay is None:
            return weights[: len(ranges), None]
        delay = realised_delay(seen)
        return np.array([delay == i for i in range(len(ranges))], dtype=float)

    def step(state, k, seen):
        trials, n = state.estimate.shape
        jacobian = dense(model.transition_jacobian(state.estimate, k - 1), (trials,), n)
        predicted = model.transition(state.estimate, k - 1)  # (23)
        predictions = (predicted, *state.predictions)
        sensors = (seen.sensor, *seen.earlier_sensors)[: len(predictions)]
        if settings.late_measurement == "current sensor":
            sensors = (seen.sensor,) * len(predictions)
        terms = list(zip(predictions, sensors, strict=True))
        rows = [
            dense(model.measurement_jacobian(x, sensor), (trials,), n)[:, 0] for x, sensor in terms
        ]
        ranges = np.stack([model.measurement(x, sensor)[:, 0] for x, sensor in terms])
        expected = (innovation_weights(seen, ranges) * ranges).sum(axis=0)
        update = minimum_variance.gain(
            rows,
            jacobian,
            state.inverses,
            weights,
            state.covariance,
            state.second_moment,
            q,
            r,
            settings.qbar_sign,
            spread_of_ranges(weights[: len(ranges), None], ranges) if matched else None,
        )
        correction = update.gain * (seen.received - expected)[:, None]
        usable = update.gain.any(axis=-1) & np.isfinite(correction).all(axis=-1)
        estimate = predicted + np.where(usable[:, None], correction, 0.0)  # (22)
        covariance = minimum_variance.covariance_update(
            update, rows[0], jacobian, weights[0], state.covariance, q
        )  # (25)
        moment = minimum_variance.second_moment_update(jacobian, state.second_moment, q)  # (27)
        inverses = (np.linalg.inv(jacobian), *state.inverses)[: max(bound - 1, 0)]
        return State(
            estimate, covariance, moment, predictions[:bound], inverses, state.degenerate + ~usable
        )

    def predict(state, k):
        return model.transition(state.estimate, k - 1)

    return Filter(
        init,
        step,
        mean=lambda state: state.estimate,
        predicted=predict,
        degenerate=lambda state: state.degenerate,
    )


def spread_of_ranges(weights: np.ndarray, ranges: np.ndarray) -> np.ndarray:
    """Variance of h over the delays, (trials,), from weights and ranges (delays, trials) in m.

    It does not depend on the origin of coordinates: the setting `matched`, not in the paper.
    """
    return (weights * ranges**2).sum(axis=0) - (weights * ranges).sum(axis=0) ** 2
