"""A standard particle filter for unknown losses, which the paper's RBPF improves upon.

Sampling, importance, resampling of Gordon, Salmond and Smith (1993): a particle is a state x(k)
with its gamma(k), both drawn from their priors, and is weighted by p(y(k) | x(k), gamma(k)). With
many particles it converges to the estimate of the RBPF in a linear system [unknown_losses Sec. IV].
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from repro.filters import Filter
from repro.filters.families import kalman
from repro.filters.families.clouds import weighted_covariance
from repro.kernels import random
from repro.kernels import sampled_states as kernels
from repro.kernels.resampling import SCHEMES
from repro.models import Model, linear_system
from repro.network.channels import Seen
from repro.parameters.settings import SampledStates
from repro.streams import Streams

LABEL = "PF (SIR)"
SEES = ("received",)


class State(NamedTuple):
    """What the filter keeps of step k."""

    keys: np.ndarray  # of the trials' random numbers, (trials,)
    states: np.ndarray  # x(k) of each trial's particles, (n, trials * particles)
    gamma: np.ndarray | None  # gamma(k) of each, (trials, particles); None before the first packet
    weights: np.ndarray  # (trials, particles)
    mean: np.ndarray  # xh(k|k), (trials, n)
    degenerate: np.ndarray  # updates so far that left no particle a weight, (trials,)


def build(model: Model, settings: SampledStates) -> Filter:
    """Settings: `particles` of a trial, drawn anew at every step by the scheme `resampling`."""
    n, m, count = len(model.initial_mean), len(model.measurement_covariance), settings.particles
    of_noise, chain = kalman.noise_log_likelihood(model), model.network
    scheme = SCHEMES[settings.resampling]

    def noise(keys: np.ndarray, k: int, purpose: int, covariance: np.ndarray) -> np.ndarray:
        """Draws of N(0, covariance) for every particle, (n, trials * particles)."""
        drawn = np.empty((len(keys), random.padded(n * count)))
        random.normals_of(keys, k, purpose, drawn)
        drawn = drawn[:, : n * count].reshape(-1, n, count).transpose(1, 0, 2).reshape(n, -1)
        return linear_system.gaussian(covariance, drawn.T).T

    def init(streams: Streams) -> State:
        trials, keys = len(streams), streams.keys()
        mean = np.array(model.initial_mean, dtype=float)
        return State(
            keys,
            mean[:, None] + noise(keys, 0, random.PRIOR, model.initial_covariance),
            None,
            np.full((trials, count), 1 / count),
            np.tile(mean, (trials, 1)),
            np.zeros(trials),
        )

    def step(state: State, k: int, seen: Seen) -> State:
        keys, states, last = state.keys, state.states.copy(), state.gamma
        if last is not None:
            last = last.copy()
            scratch = np.empty(count, dtype=np.int64), np.empty(2 * count + 4), np.empty(count)
            kernels.select(keys, k, state.weights, scheme, states, last, *scratch)
        if k > 0:  # a study may begin with the measurement of k = 0
            moved = np.asarray(model.transition(states.T, k - 1)).T
            states = moved + noise(keys, k, random.MOTION, model.process_covariance)
        uniforms = np.empty((len(keys), random.padded(count)))
        random.uniforms_of(keys, k, random.ARRIVALS, uniforms)
        gamma = (uniforms[:, :count] >= 1 - chain.arrival(last)).astype(float)
        received = seen.received.reshape(-1, m).repeat(count, axis=0)
        innovation = model.innovation(received, model.measurement(states.T, seen.sensor))
        measured = np.where(gamma.reshape(-1, 1) > 0.5, innovation, received)
        weights = of_noise(measured).reshape(gamma.shape)
        states, degenerate = np.ascontiguousarray(states), state.degenerate.copy()
        mean = np.empty_like(state.mean)
        kernels.weigh(weights, states, mean, degenerate)
        return State(keys, states, gamma, weights, mean, degenerate)

    def covariance(state: State, components: Sequence[int]) -> np.ndarray:
        clouds = state.states.reshape(n, -1, count).transpose(1, 0, 2)
        return weighted_covariance(clouds, state.weights, state.mean, components)

    def arrived(state: State) -> np.ndarray:
        gamma = np.zeros_like(state.weights) if state.gamma is None else state.gamma
        return (state.weights * gamma).sum(axis=-1)

    return Filter(
        init,
        step,
        mean=lambda state: state.mean,
        degenerate=lambda state: state.degenerate,
        arrived=arrived,
        covariance=covariance,
        particles=count,
    )
