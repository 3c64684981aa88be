"""Measurement losses that the receiver is not told of [unknown_losses (2), Sec. III-A].

gamma(k) = 1 if the packet of step k arrives, 0 if it is lost and y(k) = v(k), noise alone.
Bernoulli losses are the Markov chain (Gilbert-Elliott) whose state does not depend on the last one.
"""

from typing import Literal, NamedTuple, Protocol

import numpy as np

from repro.kernels import arrays
from repro.network.channels import Recorded


class Losses(NamedTuple):
    """The chain gamma(k) as a filter knows it: probabilities of an arrival, never an arrival."""

    first: float  # Pr(gamma = 1) of the first packet
    after_loss: float  # Pr(gamma(k) = 1 | gamma(k-1) = 0), q of Sec. III-A
    after_arrival: float  # Pr(gamma(k) = 1 | gamma(k-1) = 1), 1 - p of Sec. III-A

    def arrival(self, last: np.ndarray | None) -> np.ndarray | float:
        """Pr(gamma(k) = 1) after gamma(k-1), or after a probability of it; None at the first."""
        if last is None or self.after_loss == self.after_arrival:
            return self.first
        return self.after_loss + (self.after_arrival - self.after_loss) * last


class RecordedLosses(Recorded):
    """Channels of an open loop whose losses are kept with the runs: who judges inference asks."""

    def __init__(self, received: np.ndarray, arrival: np.ndarray):
        """(trials, steps, ...) and (trials, steps); an arrival that is not known is none."""
        super().__init__(received=received, arrival=arrival)
        self._gamma = arrival > 0.5

    def record(self) -> dict[str, np.ndarray]:
        return {"gamma": self._gamma}


class LossParameters(Protocol):
    """The parameters of a study with either kind of losses."""

    @property
    def loss_process(self) -> Literal["Bernoulli", "Markov"]: ...

    @property
    def loss_probability(self) -> float: ...

    @property
    def loss_after_arrival(self) -> float: ...

    @property
    def arrival_after_loss(self) -> float: ...


def bernoulli(loss_probability: float) -> Losses:
    """Independent losses."""
    theta = 1 - loss_probability
    return Losses(theta, theta, theta)


def markov(loss_after_arrival: float, arrival_after_loss: float) -> Losses:
    """p and q of Sec. III-A; the chain starts in its stationary distribution."""
    p, q = loss_after_arrival, arrival_after_loss
    return Losses(first=q / (p + q), after_loss=q, after_arrival=1 - p)


def losses(parameters: LossParameters) -> Losses:
    """The chain of a study's parameters."""
    if parameters.loss_process == "Bernoulli":
        return bernoulli(parameters.loss_probability)
    return markov(parameters.loss_after_arrival, parameters.arrival_after_loss)


def arrivals(uniforms: np.ndarray, chain: Losses) -> np.ndarray:
    """gamma, (trials, steps), from one uniform a step: lost where it is below the probability."""
    gamma = np.empty(uniforms.shape)
    last = None
    for k in range(uniforms.shape[1]):
        gamma[:, k] = last = (uniforms[:, k] >= 1 - chain.arrival(last)).astype(float)
    return gamma


def sensed(received: np.ndarray, gamma: np.ndarray, noiseless: np.ndarray) -> np.ndarray:
    """noiseless + v, bit by bit: what arrives, and for a lost packet with the v that is received.

    All arrays (trials, steps, components), gamma with one component.
    """
    return np.where(gamma == 1, received, noiseless + received)


def log_odds(probability: np.ndarray | float) -> np.ndarray:
    """log(p / (1 - p)); infinite, not NaN, at 0 and 1."""
    return arrays.log(probability) - arrays.log1p(-np.asarray(probability))


def inferred_rightly(recorded: dict[str, np.ndarray]) -> np.ndarray:
    """Share of the steps after the first at which a filter infers gamma rightly, (trials,)."""
    return (recorded["arrived"] == recorded["gamma"])[:, 1:].mean(axis=1)
