"""A linear system with unknown measurement losses [unknown_losses Sec. VI-A]."""

from types import MappingProxyType
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from repro.logs import Log
from repro.models import Model, linear_system
from repro.network import losses
from repro.parameters.values import (
    Covariance2,
    Pair,
    PointParameters,
    Positive,
    Probability,
    Values,
)
from repro.statistics import metrics
from repro.statistics.runs import Runs
from repro.statistics.shards import Shards
from repro.studies import Fields, Integers, Rows, StreamsOf, Study
from repro.studies.families.information import Information, of_model

COMPONENTS = ("x1", "x2")


class Parameters(PointParameters):
    """Values of one point; the system has no units."""

    transition_matrix: Annotated[tuple[Pair, Pair], Field(description="F of (20)")]
    measurement_row: Annotated[Pair, Field(description="H of (20)")]
    process_covariance: Annotated[Covariance2, Field(description="Q")]
    measurement_variance: Annotated[Positive, Field(description="R")]
    initial_mean: Annotated[Pair, Field(description="mean of x(0)")]
    initial_covariance: Annotated[Covariance2, Field(description="covariance of x(0)")]
    loss_process: Annotated[
        Literal["Bernoulli", "Markov"], Field(description="whether losses depend on the last one")
    ]
    loss_probability: Annotated[
        Probability, Field(description="Pr(gamma(k) = 0) of Bernoulli losses")
    ]
    loss_after_arrival: Annotated[
        Probability, Field(description="Pr(gamma(k) = 0 | gamma(k-1) = 1) of Markov losses")
    ]
    arrival_after_loss: Annotated[
        Probability, Field(description="Pr(gamma(k) = 1 | gamma(k-1) = 0) of Markov losses")
    ]


class Analysis(Values):
    """Thresholds of the claims."""

    critical_particles: Annotated[
        int, Field(ge=1, description="particles up to which the RMSE of Fig. 2 falls quickly")
    ]
    few_particles: Annotated[
        int, Field(ge=1, description="particles with which the need for more is measured")
    ]
    close_within: Annotated[
        Positive, Field(description="RMSE of a filter that comes close, over the IKF's, or inverse")
    ]
    much_better_by: Annotated[
        Positive, Field(description="RMSE of a filter over that of one that is much better")
    ]
    greatly_faster_by: Annotated[
        Positive, Field(description="time of an algorithm over that of a greatly faster one")
    ]
    inferred_above: Annotated[
        Probability, Field(description="share of losses and arrivals that are inferred rightly")
    ]
    proportional_within: Annotated[
        Positive, Field(description="deviation of log10 of a ratio of times from proportionality")
    ]
    duplicates_above: Annotated[
        Probability, Field(description="share of the triples above which most are duplicates")
    ]
    limit_nearer_by: Annotated[
        Positive, Field(description="factor by which more particles bring the RBPF to its limit")
    ]
    bounded_within: Annotated[
        Positive, Field(description="ratio of later to earlier mean squared error if bounded")
    ]


def squared_error(runs: Runs) -> np.ndarray:
    """|x(k) - xh(k|k)|^2, (trials, steps)."""
    return _sum(runs.error * runs.error)


def inferred_rightly(runs: Runs) -> np.ndarray:
    """Share of the steps at which the filter infers the loss or arrival rightly, (trials,)."""
    return losses.inferred_rightly(runs.recorded)


def claimed_mean_square(runs: Runs) -> np.ndarray:
    """Sum of the claimed variances, mean over the steps, (trials,)."""
    assert runs.claimed is not None
    claimed = np.broadcast_to(runs.claimed, runs.error.shape)  # some claim it for all trials alike
    return _sum(claimed).mean(axis=1)


def _sum(values: np.ndarray) -> np.ndarray:
    """Over the two components, (..., 2); a sum of NumPy's over so short an axis is slow."""
    return values[..., 0] + values[..., 1]


def _measurement(truth: np.ndarray, parameters: Parameters) -> np.ndarray:
    """C x(k), (trials, steps, 1)."""
    return linear_system.product(np.array([parameters.measurement_row]), truth)


class LinearLosses(Study):
    """Error of the whole state over the loss probability and the number of particles.

    [unknown_losses Figs. 1, 2].
    """

    Parameters = Parameters
    Analysis = Analysis
    keeps_inferred_arrivals = True
    best_filters = MappingProxyType({"exact": "losses unknown"})
    judged_components = MappingProxyType({"state": (0, 1)})
    systems_per_block = 20000  # a call of NumPy costs as much as hundreds of systems

    def topics(self, parameters: Parameters) -> Fields:
        return {
            "/truth": COMPONENTS,
            "/sensor": ("z",),
            "/received": ("y",),
            "/network": ("gamma",),
        }

    def first_step(self, parameters: Parameters) -> int:
        return 0  # Algorithms 1-3 update with y(0) before any prediction

    def simulate(self, parameters: Parameters, streams: StreamsOf) -> dict[str, np.ndarray]:
        steps = parameters.steps
        prior, process = (
            linear_system.gaussian(np.array(covariance), streams(role).standard_normal(*shape, 2))
            for role, shape, covariance in (
                ("prior", (), parameters.initial_covariance),
                ("process", (steps - 1,), parameters.process_covariance),
            )
        )
        truth = linear_system.trajectory(
            np.array(parameters.transition_matrix),
            np.array(parameters.initial_mean) + prior,
            process,
        )  # (20)
        measured = _measurement(truth, parameters)
        v = np.sqrt(parameters.measurement_variance) * streams("sensor").standard_normal(steps)
        gamma = losses.arrivals(streams("network").uniform(steps), losses.losses(parameters))
        return {
            "/truth": truth,
            "/sensor": measured + v[:, :, None],
            "/received": gamma[:, :, None] * measured + v[:, :, None],
            "/network": gamma[:, :, None],
        }

    def derived(self, parameters: Parameters) -> Fields:
        return {"/sensor": self.topics(parameters)["/sensor"]}

    def recomputed(self, log: Log) -> dict[str, np.ndarray]:
        received, gamma = log.values["/received"], log.values["/network"]
        noiseless = _measurement(log.values["/truth"], log.parameters)
        return {"/sensor": losses.sensed(received, gamma, noiseless)}

    def model(self, parameters: Parameters) -> Model:
        transition = np.array(parameters.transition_matrix)
        measurement = np.array([parameters.measurement_row])
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

    def channel_topics(self, parameters: Parameters) -> dict[str, Fields]:
        return {
            "received": {"/received": ("y",)},
            "arrival": {"/network": ("gamma",)},
        }

    def integers(self, parameters: Parameters) -> Integers:
        return {"/network": {"gamma": (0, 1)}}

    def channels(self, log: Log, trials: slice) -> losses.RecordedLosses:
        return losses.RecordedLosses(
            received=log.values["/received"][trials],
            arrival=log.field("/network", "gamma")[trials],
        )

    def information(self, log: Log) -> Information:
        gamma, first = log.field("/network", "gamma"), self.first_step(log.parameters)
        return of_model(self.model(log.parameters), log.values["/truth"], gamma, first)

    def squared_error(self, runs: Runs) -> np.ndarray:
        """|x(k) - xh(k|k)|^2 at k = 1, 2, ..., (trials, steps)."""
        return squared_error(runs)[:, 1:]

    def rows(self, shards: Shards, analysis: Analysis) -> Rows:
        rmse_sum = metrics.roots_over_steps(shards.each(squared_error), average=False)
        yield "rmse_sum", "state", metrics.statistic(rmse_sum)
        mean_squared = shards.each(lambda runs: squared_error(runs).mean(axis=1))
        yield "mse", "state", metrics.mean(mean_squared)
        if shards.first.claimed is not None:
            yield "claimed_mse", "state", metrics.mean(shards.each(claimed_mean_square))
        if "arrived" in shards.first.recorded:
            yield "inferred", "gamma", metrics.mean(shards.each(inferred_rightly))
        if "triples" in shards.first.recorded:
            triples = shards.each(lambda runs: runs.recorded["triples"].mean(axis=1))
            yield "triples", "state", metrics.mean(triples)

    def curves(self, shards: Shards) -> Rows:
        yield "rmse", "state", metrics.root_mean(shards.each(squared_error))


STUDY = LinearLosses()
