"""Extended Kalman filter that weighs each measurement by what it knows or infers of its loss.

Equations are those of [unknown_losses].
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from repro.filters import Filter
from repro.filters.families import kalman
from repro.models import Model
from repro.network.channels import Seen
from repro.network.losses import Losses, log_odds
from repro.streams import Streams

Evidence = Callable[[], np.ndarray]  # log N(e; 0, S) - log N(y; 0, R), (trials,)
# The weight of y(k) in the update, (trials,) or one for all, and what to keep of gamma(k).
Weighed = tuple[Any, Any]
Weigh = Callable[[Seen, Evidence, Any], Weighed]  # (seen, evidence, what was kept of gamma(k-1))


class State(NamedTuple):
    """What the filter keeps of step k."""

    estimate: np.ndarray  # xh(k|k), (n, trials)
    covariance: np.ndarray  # Sigma(k|k), packed, (n (n + 1) / 2, trials)
    last: Any  # what the filter keeps of gamma(k), (trials,); None before the first packet
    weight: Any = 0.0  # of y(k) in the update, (trials,) or one for all
    innovation: kalman.Innovation | None = None  # None before the first packet


def build(model: Model, weigh: Weigh, spread: bool = False, channel: str = "received") -> Filter:
    """The filter on the measurements of a channel.

    A weight of 1 uses y(k) as a measurement, and 0 ignores it. With `spread` the weight is a
    probability, and the spread of the means with and without y(k) is added to the covariance.
    """
    m = len(model.measurement_covariance)
    of_noise = kalman.noise_log_likelihood(model)

    def init(streams: Streams) -> State:
        return State(*kalman.start(model, len(streams)), last=None)

    def predict(
        state: State, k: int, known_input: np.ndarray | None
    ) -> tuple[np.ndarray, np.ndarray]:
        if k == 0:  # the first measurement of a study that starts with an update
            return state.estimate.copy(), state.covariance.copy()
        return kalman.predict(model, state.estimate, state.covariance, k - 1, known_input)  # (5)

    def step(state: State, k: int, seen: Seen) -> State:
        estimate, covariance = predict(state, k, seen.input)
        received = getattr(seen, channel).reshape(-1, m)
        innovation = kalman.innovate(model, estimate, covariance, received, seen.sensor)

        def evidence() -> np.ndarray:
            return innovation.log_likelihood - of_noise(received)

        weight, last = weigh(seen, evidence, state.last)
        corrected = kalman.correct(estimate, covariance, innovation, weight, spread)  # (4)
        return State(*corrected, last, weight, innovation)

    def normalised_innovation(state: State) -> np.ndarray:
        """Of the steps at which y(k) is taken for a measurement."""
        if state.innovation is None:
            return np.full(state.estimate.shape[1], np.nan)
        return np.where(np.greater(state.weight, 0.5), kalman.normalised(state.innovation), np.nan)

    return Filter(
        init,
        step,
        mean=lambda state: state.estimate.T,
        predicted=lambda state, k: model.transition(state.estimate.T, k - 1),
        variance=lambda state: kalman.variances(state.covariance, len(state.estimate)).T,
        arrived=lambda state: np.broadcast_to(state.weight, state.estimate.shape[1:]),
        covariance=lambda state, components: kalman.covariances(
            state.covariance, len(state.estimate), components
        ),
        normalised_innovation=normalised_innovation,
    )


def prior_odds(chain: Losses) -> Callable[[Any], Any]:
    """Log odds of gamma(k) = 1 after what is kept of gamma(k-1), None at the first packet."""
    first = log_odds(chain.first)

    def odds(last: Any) -> Any:
        probability = chain.arrival(last)
        return log_odds(probability) if isinstance(probability, np.ndarray) else first

    return odds
