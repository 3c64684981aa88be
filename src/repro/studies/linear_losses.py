"""A linear system with unknown measurement losses (Zhang, You, Xie 2018, Sec. VI-A)."""

from typing import Literal

import numpy as np

from repro.logs import Log
from repro.models import Model, linear_system
from repro.models.sparse import rows as sparse_rows
from repro.network import losses
from repro.network.channels import Recorded
from repro.parameters.values import (
    Covariance2,
    Pair,
    PointParameters,
    Positive,
    Probability,
)
from repro.statistics import metrics
from repro.statistics.shards import Shards
from repro.studies import Rows, Study

COMPONENTS = ("x1", "x2")


class Parameters(PointParameters):
    """Values of one point."""

    transition_matrix: tuple[Pair, Pair]
    measurement_row: Pair
    process_covariance: Covariance2
    measurement_variance: Positive
    initial_mean: Pair
    initial_covariance: Covariance2
    loss_process: Literal["Bernoulli", "Markov"]
    loss_probability: Probability
    loss_after_arrival: Probability
    arrival_after_loss: Probability


def squared_error(runs) -> np.ndarray:
    """|x(k) - xh(k|k)|^2, (trials, steps)."""
    return np.vecdot(runs.error, runs.error)


class LinearLosses(Study):
    """..."""

    Parameters = Parameters
    systems_per_block = (
        10000  # systems, trials times particles: few calls, and their rows stay cached
    )

    def topics(self, parameters: Parameters) -> dict[str, tuple[str, ...]]:
        return {
            "/truth": COMPONENTS,
            "/sensor": ("z",),
            "/received": ("y",),
            "/network": ("gamma",),
        }

    def first_step(self, parameters: Parameters) -> int:
        return 0  # Algorithms 1-3 update with y(0) before any prediction

    def simulate(self, parameters: Parameters, streams) -> dict[str, np.ndarray]:
        steps = parameters.steps
        prior = linear_system.root(np.array(parameters.initial_covariance))
        process = linear_system.root(np.array(parameters.process_covariance))
        x0 = np.matvec(prior, streams("prior").standard_normal(len(COMPONENTS)))
        truth = linear_system.trajectory(
            sparse_rows(parameters.transition_matrix),
            np.array(parameters.initial_mean) + x0,
            np.matvec(process, streams("process").standard_normal(steps - 1, len(COMPONENTS))),
        )  # (20)
        measured = np.vecdot(truth, np.array(parameters.measurement_row))
        v = np.sqrt(parameters.measurement_variance) * streams("sensor").standard_normal(steps)
        gamma = losses.arrivals(streams("network").uniform(steps), losses.losses(parameters))
        return {
            "/truth": truth,
            "/sensor": (measured + v)[:, :, None],
            "/received": (gamma * measured + v)[:, :, None],
            "/network": gamma[:, :, None],
        }

    def model(self, parameters: Parameters) -> Model:
        transition = sparse_rows(parameters.transition_matrix)
        measurement = sparse_rows([parameters.measurement_row])
        return Model(
            transition=lambda x, k: linear_system.product(transition, x),
            transition_jacobian=lambda x, k: transition,
            measurement=lambda x, sensor: linear_system.product(measurement, x),
            measurement_jacobian=lambda x, sensor: measurement,
            process_covariance=np.array(parameters.process_covariance),
            measurement_covariance=np.array([[parameters.measurement_variance]]),
            initial_mean=np.array(parameters.initial_mean),
            initial_covariance=np.array(parameters.initial_covariance),
            network=losses.losses(parameters),
        )

    def channels(self, log: Log, trials: slice) -> Recorded:
        return Recorded(
            received=log.values["/received"][trials],
            arrival=log.field("/network", "gamma")[trials],
        )

    def rows(self, shards: Shards, analysis) -> Rows:
        rmse_sum = metrics.roots_over_steps(shards.each(squared_error), average=False)
        yield "rmse_sum", "state", metrics.statistic(rmse_sum)
        mean_squared = shards.each(lambda runs: squared_error(runs).mean(axis=1))
        yield "mse", "state", metrics.mean(mean_squared)
        claimed = shards.each(lambda runs: runs.claimed.sum(axis=-1).mean(axis=1))
        yield "claimed_mse", "state", metrics.mean(claimed)
        if "triples" in shards.first.recorded:
            triples = shards.each(lambda runs: runs.recorded["triples"].mean(axis=1))
            yield "triples", "state", metrics.mean(triples)

    def curves(self, shards: Shards) -> Rows:
        yield "rmse", "state", metrics.root_mean(shards.each(squared_error))


STUDY = LinearLosses()
