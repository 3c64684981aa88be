"""Protocol-based particle filters for a complex network [censored_network Algorithm 1].

The nodes' filters run in lockstep: each takes the others' estimates of step k, never of step
k + 1, as the known input of its coupling. The paper's filters differ in three arguments: whether
the coupling is drawn, whether the likelihood accounts for the censoring, and whether particles are
chosen with the new measurement (auxiliary) or without it (bootstrap).
"""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from repro.filters import Filter
from repro.filters.families import censored_likelihood
from repro.filters.families.clouds import weighted_covariance
from repro.kernels import coupled_targets_step as kernels
from repro.kernels.resampling import SCHEMES
from repro.models.coupled_targets import CoupledTargets
from repro.parameters.settings import ProtocolParticles
from repro.streams import Streams


class Cloud(NamedTuple):
    """Weighted particles of the nodes of each trial, and what is estimated from them."""

    particles: np.ndarray  # (trials, nodes, 3, particles)
    weights: np.ndarray  # (trials, nodes, particles), each row sums to one
    mean: np.ndarray  # sum of w x, (trials, nodes, 3)
    effective_sample_size: np.ndarray  # mean of the nodes, (trials,)
    degenerate: np.ndarray  # updates so far that no particle explained, (trials,)
    keys: np.ndarray  # of the trials' random numbers, (trials,)


def auxiliary(
    model: CoupledTargets,
    settings: ProtocolParticles,
    coupled: bool = True,
    compensated: bool = True,
) -> Filter:
    """[censored_network Algorithm 1] with the weights (22); uncoupled, with the same draws."""
    if not coupled:
        model = model._replace(coupling=np.zeros_like(model.coupling))
    return _with_measurements(kernels.auxiliary, model, settings, compensated)


def bootstrap(model: CoupledTargets, settings: ProtocolParticles) -> Filter:
    """The same draws and likelihood with standard resampling."""
    return _with_measurements(kernels.bootstrap, model, settings, True)


def dead_reckoning(model: CoupledTargets, settings: ProtocolParticles) -> Filter:
    """The same draws without a measurement."""
    motion = _motion(model, settings)

    def advance(k: int, seen: Any, keys: np.ndarray, clouds: tuple, scratch: tuple) -> None:
        kernels.dead_reckoning(keys, k, motion, *clouds, scratch)

    return _filter(advance, model, settings)


def prior(model: CoupledTargets, streams: Streams, particles: int) -> np.ndarray:
    """Particles of p(x(0)), (trials, nodes, 3, particles)."""
    mean = model.initial_mean.reshape(-1, 3)
    drawn = streams.standard_normal(*mean.shape, particles)
    return mean[:, :, None] + model.initial_deviation[:, None] * drawn


def _with_measurements(
    kernel: Callable, model: CoupledTargets, settings: ProtocolParticles, compensated: bool
) -> Filter:
    motion, network = _motion(model, settings), censored_likelihood.network(model)
    scheme = SCHEMES[settings.resampling]

    def advance(k: int, seen: Any, keys: np.ndarray, clouds: tuple, scratch: tuple) -> None:
        reading = censored_likelihood.reading(model, seen, compensated)
        kernel(keys, k, reading, motion, network, scheme, *clouds, scratch)

    return _filter(advance, model, settings)


def _motion(model: CoupledTargets, settings: ProtocolParticles) -> tuple:
    """As the kernels have it."""
    return (
        np.array(model.speed, dtype=float),
        float(model.turn_rate),
        np.array(model.process_deviation, dtype=float),
        np.array(model.coupling, dtype=float, order="C"),
        float(model.coupling_rate),
        settings.coupling_drawn_per == "particle",
    )


def _filter(advance: Callable, model: CoupledTargets, settings: ProtocolParticles) -> Filter:
    """The filter whose kernel `advance` writes the cloud of step k over that of step k - 1."""
    count = settings.particles

    def init(streams: Streams) -> Cloud:
        particles = prior(model, streams, count)
        trials, nodes, _, _ = particles.shape
        return Cloud(
            particles,
            weights=np.full((trials, nodes, count), 1.0 / count),
            mean=particles.mean(axis=-1),
            effective_sample_size=np.full(trials, float(count)),
            degenerate=np.zeros(trials),
            keys=streams.keys(),
        )

    def step(cloud: Cloud, k: int, seen: Any) -> Cloud:
        after = Cloud(
            np.empty_like(cloud.particles),
            cloud.weights.copy(),
            np.empty_like(cloud.mean),
            cloud.effective_sample_size.copy(),
            cloud.degenerate.copy(),
            cloud.keys,
        )
        drawn = np.empty(kernels.drawn_length(count))
        scratch = np.empty(count, dtype=np.int64), drawn, np.empty((kernels.ROWS, count))
        advance(k, seen, cloud.keys, (cloud[:5], after[:5]), scratch)
        return after

    def covariance(cloud: Cloud, components: Sequence[int]) -> np.ndarray:
        """Of components of one node: the filters of the nodes have particles of their own."""
        (node,) = {component // 3 for component in components}
        of_node = (cloud.particles[:, node], cloud.weights[:, node], cloud.mean[:, node])
        return weighted_covariance(*of_node, [component % 3 for component in components])

    return Filter(
        init,
        step,
        mean=lambda cloud: cloud.mean.reshape(len(cloud.mean), -1),
        degenerate=lambda cloud: cloud.degenerate,
        diagnostics=lambda cloud: {"effective_sample_size": cloud.effective_sample_size},
        covariance=covariance,
    )
