"""Core of every particle filter: weighted clouds, resampling, and the bootstrap step.

A cloud is (trials, [nodes,] n, particles): components stand before particles, so that each
component is contiguous in memory and a row (a trial, or a node of a trial) never mixes with
another. A model written for trailing state axes takes the view np.moveaxis(cloud, -2, -1).
"""

from collections.abc import Callable
from typing import NamedTuple

import numpy as np

from repro.filters import Filter
from repro.kernels import resampling
from repro.kernels.normals import standard_normal
from repro.streams import Streams


class Cloud(NamedTuple):
    """Weighted particles of each row, and what is estimated from them."""

    particles: np.ndarray  # (trials, [nodes,] n, particles)
    weights: np.ndarray  # (trials, [nodes,] particles), each row sums to one
    mean: np.ndarray  # sum of w x, (trials, [nodes,] n)
    degenerate: np.ndarray  # updates so far that no particle explained, (trials,)
    streams: Streams  # of the filter, one a trial


def gaussian(streams: Streams, mean: np.ndarray, root: np.ndarray, particles: int) -> np.ndarray:
    """Particles of N(mean, root root'), (trials, *mean.shape, particles); mean ([nodes,] n)."""
    drawn = standard_normal(streams, *mean.shape, particles)
    return mean[..., None] + root @ drawn


def equally_weighted(particles: np.ndarray, streams: Streams) -> Cloud:
    """The cloud before the first measurement."""
    trials, count = len(particles), particles.shape[-1]
    weights = np.full((*particles.shape[:-2], count), 1.0 / count)
    return Cloud(particles, weights, particles.mean(axis=-1), np.zeros(trials), streams)


def weighted(particles: np.ndarray, log_weights: np.ndarray, before: Cloud) -> Cloud:
    """The cloud with these log weights, (trials, [nodes,] particles), in any common scale.

    A row whose log weights are all -inf gets equal weights and is counted as degenerate.
    """
    weights, degenerate = resampling.normalised(log_weights)
    return Cloud(
        particles,
        weights,
        np.vecdot(weights[..., None, :], particles),
        before.degenerate + degenerate.reshape(len(degenerate), -1).sum(axis=1),
        before.streams,
    )


def parents(weights: np.ndarray, streams: Streams, scheme: str = "systematic") -> np.ndarray:
    """Indices of the drawn particles of each row, as the weights, (trials, [nodes,] particles)."""
    *rows, count = weights.shape
    flat = weights.reshape(-1, count)
    if scheme == "systematic":
        drawn = resampling.systematic(flat, streams.uniform(*rows[1:], 1).reshape(-1))
    else:
        drawn = resampling.multinomial(flat, streams.uniform(*rows[1:], count).reshape(-1, count))
    return drawn.reshape(weights.shape)


def taken(values: np.ndarray, chosen: np.ndarray) -> np.ndarray:
    """Values of the chosen particles; values (*rows, particles) or (*rows, n, particles)."""
    if values.ndim > chosen.ndim:
        chosen = chosen[..., None, :]
    # One flat index into all rows: three times faster than numpy.take_along_axis.
    *rows, count = values.shape
    starts = np.arange(0, values.size, count).reshape(*rows, 1)
    return values.reshape(-1).take(starts + chosen)


def bootstrap(
    draw_initial: Callable, move: Callable, log_likelihood: Callable, scheme: str = "systematic"
) -> Filter:
    """Gordon, Salmond, Smith (1993): resample, move, weight; the estimate is the weighted mean.

    draw_initial(streams)           -> particles of the prior
    move(particles, cloud, k)       -> particles of step k from those of step k - 1, with noise from
                                       cloud.streams; cloud.mean is the estimate of step k - 1
    log_likelihood(particles, seen, k) -> (trials, [nodes,] particles), up to a constant of each row
    """

    def init(streams):
        return equally_weighted(draw_initial(streams), streams)

    def step(cloud, k, seen):
        chosen = parents(cloud.weights, cloud.streams, scheme)
        particles = move(taken(cloud.particles, chosen), cloud, k)
        return weighted(particles, log_likelihood(particles, seen, k), cloud)

    return as_filter(init, step)


def auxiliary(
    draw_initial: Callable,
    drift: Callable,
    disturb: Callable,
    log_likelihood: Callable,
    scheme: str = "systematic",
) -> Filter:
    """Pitt, Shephard (1999) with drawn intermediate particles, as Song et al., Algorithm 1.

    drift(particles, k)        -> what a transition is before its noise
    disturb(moved, cloud, k)   -> one draw of the transition, with noise from cloud.streams
    The two draws from a parent are independent: the same one twice would weigh nothing.
    """

    def init(streams):
        return equally_weighted(draw_initial(streams), streams)

    def step(cloud, k, seen):
        moved = drift(cloud.particles, k)
        # Intermediate particles; indices with probability prop. to w p(y | eta)
        first = log_likelihood(disturb(moved, cloud, k), seen, k)
        with np.errstate(divide="ignore"):
            log_first_stage = np.log(cloud.weights)
        log_first_stage += first
        first_stage, unexplained = resampling.normalised(log_first_stage)
        chosen = parents(first_stage, cloud.streams, scheme)
        # A fresh draw from each chosen parent, weighted by p(y | x) / p(y | eta of the parent)
        particles = disturb(taken(moved, chosen), cloud, k)
        log_weights = log_likelihood(particles, seen, k)
        if unexplained.any():  # there is no first stage to divide by
            first = np.where(unexplained[..., None], 0.0, first)
        log_weights -= taken(first, chosen)
        counted = cloud.degenerate + unexplained.reshape(len(unexplained), -1).sum(axis=1)
        return weighted(particles, log_weights, cloud._replace(degenerate=counted))

    return as_filter(init, step)


def as_filter(init: Callable, step: Callable) -> Filter:
    """A filter whose state is a Cloud; the estimates of all nodes stand in one row."""
    return Filter(
        init,
        step,
        mean=lambda cloud: cloud.mean.reshape(len(cloud.mean), -1),
        degenerate=lambda cloud: cloud.degenerate,
        diagnostics=lambda cloud: {
            "effective_sample_size": _of_a_trial(resampling.effective_sample_size(cloud.weights))
        },
    )


def _of_a_trial(values: np.ndarray) -> np.ndarray:
    return values.reshape(len(values), -1).mean(axis=1)
