"""The exact estimate without knowledge of the losses: every loss sequence has its Kalman filter.

Not in the paper, and for short horizons only: the number of sequences doubles at every packet. For
a linear system it is the minimum mean squared error estimate, to which the RBPF converges.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from repro.filters import Filter
from repro.filters.families import kalman
from repro.kernels import arrays
from repro.models import Model
from repro.network.channels import Seen
from repro.streams import Streams

LABEL = "exact"
SEES = ("received",)
SEQUENCES = 2**12  # at the end of the longest horizon: how the runner sizes its blocks


class State(NamedTuple):
    """A Kalman filter a loss sequence."""

    estimate: np.ndarray  # of each trial's sequences, (n, trials * sequences)
    covariance: np.ndarray  # packed, (n (n + 1) / 2, trials * sequences)
    last: np.ndarray | None  # gamma(k) of each sequence, (sequences,)
    log_weights: np.ndarray  # log Pr(sequence | y(0) ... y(k)) + constant, (trials, sequences)


def build(model: Model, settings: dict[str, Any]) -> Filter:
    n, m, chain = len(model.initial_mean), len(model.measurement_covariance), model.network
    of_noise = kalman.noise_log_likelihood(model)

    def init(streams: Streams) -> State:
        trials = len(streams)
        return State(*kalman.start(model, trials), None, np.zeros((trials, 1)))

    def step(state: State, k: int, seen: Seen) -> State:
        estimate, covariance, last, log_weights = state
        trials, sequences = log_weights.shape
        if k > 0:
            estimate, covariance = kalman.predict(model, estimate, covariance, k - 1)
        received = seen.received.reshape(-1, m)
        innovation = kalman.innovate(
            model, estimate, covariance, received.repeat(sequences, axis=0), seen.sensor
        )
        likelihood = innovation.log_likelihood.reshape(trials, sequences)
        arrival = np.asarray(chain.arrival(last))
        # An impossible sequence has the log weight -inf.
        arrived = log_weights + arrays.log(arrival) + likelihood
        lost = log_weights + arrays.log1p(-arrival) + of_noise(received)[:, None]
        updated = kalman.correct(estimate.copy(), covariance.copy(), innovation, 1.0)

        def both(if_lost, if_arrived):
            parts = [part.reshape(-1, trials, sequences) for part in (if_lost, if_arrived)]
            return np.concatenate(parts, axis=-1).reshape(len(if_lost), -1)

        return State(
            both(estimate, updated[0]),
            both(covariance, updated[1]),
            np.repeat([0.0, 1.0], sequences),
            np.concatenate([lost, arrived], axis=-1),
        )

    def combined(state: State, values: np.ndarray) -> np.ndarray:
        """Weighted sum over the sequences of (m, trials * sequences), (trials, m)."""
        weights = arrays.exp(state.log_weights - state.log_weights.max(axis=-1, keepdims=True))
        weights /= weights.sum(axis=-1, keepdims=True)
        return (values.reshape(-1, *weights.shape) * weights).sum(axis=-1).T

    def mean(state: State) -> np.ndarray:
        return combined(state, state.estimate)

    def variance(state: State) -> np.ndarray:
        sequences = state.log_weights.shape[1]
        spread = (state.estimate - mean(state).T.repeat(sequences, axis=-1)) ** 2
        return combined(state, kalman.variances(state.covariance, n) + spread)

    def covariance(state: State, components: Sequence[int]) -> np.ndarray:
        sequences, d = state.log_weights.shape[1], len(components)
        error = state.estimate - mean(state).T.repeat(sequences, axis=-1)
        of_each = np.moveaxis(kalman.covariances(state.covariance, n, components), 0, -1)
        spread = error[components, None] * error[None, components]
        return combined(state, (of_each + spread).reshape(d * d, -1)).reshape(-1, d, d)

    return Filter(init, step, mean, variance=variance, covariance=covariance, particles=SEQUENCES)
