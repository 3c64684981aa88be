"""Core of the particle filters: weighted clouds, resampling, bootstrap and auxiliary steps.

A cloud is (trials, [nodes,] n, particles). Components come before particles, so that each is
contiguous in memory; a row is a trial, or a node of a trial, and rows never mix. A model written
for trailing state axes takes the view np.moveaxis(cloud, -2, -1).
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from repro.filters import Filter
from repro.kernels import resampling
from repro.kernels.normals import standard_normal
from repro.parameters.settings import Resampling
from repro.streams import Streams


class Cloud(NamedTuple):
    """Weighted particles of each row, and their mean."""

    particles: np.ndarray  # (trials, [nodes,] n, particles)
    weights: np.ndarray  # (trials, [nodes,] particles), each row sums to one
    mean: np.ndarray  # sum of w x, (trials, [nodes,] n)
    degenerate: np.ndarray  # updates so far in which every weight was zero, (trials,)
    streams: Streams  # of the filter, one per trial


DrawInitial = Callable[[Streams], np.ndarray]  # particles of the prior
Drift = Callable[[np.ndarray, int], np.ndarray]  # particles, k
Draw = Callable[[np.ndarray, Cloud, int], np.ndarray]  # particles, cloud, k
LogLikelihood = Callable[[np.ndarray, Any, int], np.ndarray]  # particles, seen, k


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
    """The cloud with these log weights, (trials, [nodes,] particles), up to a constant per row.

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


def parents(weights: np.ndarray, streams: Streams, scheme: Resampling = "systematic") -> np.ndarray:
    """Indices of the resampled particles of each row; weights (trials, [nodes,] particles)."""
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
    # One flat index into all rows is three times as fast as numpy.take_along_axis.
    *rows, count = values.shape
    starts = np.arange(0, values.size, count).reshape(*rows, 1)
    return values.reshape(-1).take(starts + chosen)


def bootstrap(
    draw_initial: DrawInitial,
    move: Draw,
    log_likelihood: LogLikelihood,
    scheme: Resampling = "systematic",
) -> Filter:
    """Gordon, Salmond, Smith (1993): resample, move, weight; the estimate is the weighted mean.

    draw_initial(streams)              -> particles of the prior
    move(particles, cloud, k)          -> particles of step k from those of step k - 1, with noise
                                          from cloud.streams; cloud.mean is the estimate of k - 1
    log_likelihood(particles, seen, k) -> (trials, [nodes,] particles), up to a constant per row
    """

    def init(streams: Streams) -> Cloud:
        return equally_weighted(draw_initial(streams), streams)

    def step(cloud: Cloud, k: int, seen: Any) -> Cloud:
        chosen = parents(cloud.weights, cloud.streams, scheme)
        particles = move(taken(cloud.particles, chosen), cloud, k)
        return weighted(particles, log_likelihood(particles, seen, k), cloud)

    return as_filter(init, step)


def auxiliary(
    draw_initial: DrawInitial,
    drift: Drift,
    disturb: Draw,
    log_likelihood: LogLikelihood,
    scheme: Resampling = "systematic",
) -> Filter:
    """Pitt, Shephard (1999) with drawn intermediate particles [censored_network Algorithm 1].

    drift(particles, k)        -> the transition without its noise
    disturb(moved, cloud, k)   -> one draw of the transition, with noise from cloud.streams
    The two draws from a parent are independent; with the same draw twice all weights were equal.
    """

    def init(streams: Streams) -> Cloud:
        return equally_weighted(draw_initial(streams), streams)

    def step(cloud: Cloud, k: int, seen: Any) -> Cloud:
        moved = drift(cloud.particles, k)
        # Intermediate particles eta; an index has a probability proportional to w p(y | eta).
        first = log_likelihood(disturb(moved, cloud, k), seen, k)
        with np.errstate(divide="ignore"):
            log_first_stage = np.log(cloud.weights)
        log_first_stage += first
        first_stage, unexplained = resampling.normalised(log_first_stage)
        chosen = parents(first_stage, cloud.streams, scheme)
        # A fresh draw from each chosen parent, weighted by p(y | x) / p(y | eta of the parent).
        particles = disturb(taken(moved, chosen), cloud, k)
        log_weights = log_likelihood(particles, seen, k)
        if unexplained.any():  # no first stage to divide by
            first = np.where(unexplained[..., None], 0.0, first)
        log_weights -= taken(first, chosen)
        counted = cloud.degenerate + unexplained.reshape(len(unexplained), -1).sum(axis=1)
        return weighted(particles, log_weights, cloud._replace(degenerate=counted))

    return as_filter(init, step)


def as_filter(init: Callable[[Streams], Cloud], step: Callable[[Cloud, int, Any], Cloud]) -> Filter:
    """A filter whose state is a Cloud; the estimates of a trial's nodes are joined in one row."""
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
