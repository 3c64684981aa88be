"""The linear example with packet delays [packet_delays Sec. 4.1, Figs. 1-2]."""

from types import MappingProxyType
from typing import Annotated

import numpy as np
from pydantic import Field

from repro.logs import Log
from repro.models import DelayNetwork, LinearModel, linear_plant
from repro.network import packet_delays
from repro.network.channels import Recorded
from repro.parameters.values import (
    Covariance2,
    NotNegative,
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

COMPONENTS = ("x1", "x2")


class Parameters(PointParameters):
    """Values of one point. The example has no physical units."""

    process_noise_entry: Annotated[Pair, Field(description="vector by which w(k) enters the state")]
    process_noise_variance: Annotated[NotNegative, Field(description="variance of w(k), a scalar")]
    measurement_row: Annotated[Pair, Field(description="row C of z(k) = C x(k) + v(k)")]
    measurement_variance: Annotated[Positive, Field(description="variance R of v(k)")]
    sine_period: Annotated[Positive, Field(description="steps, period of the sine in A(k)")]
    packet_bound: Annotated[int, Field(ge=1, description="steps, largest delay N of a packet")]
    arrival_probability: Annotated[
        Probability, Field(description="probability p that a transmission succeeds")
    ]
    true_initial_state: Annotated[Pair, Field(description="x(0) of every trial")]
    initial_estimate: Annotated[Pair, Field(description="xh(0|0)")]
    initial_covariance: Annotated[Covariance2, Field(description="P(0|0)")]
    initial_second_moment: Annotated[Covariance2, Field(description="S(0), of x(0)")]


class Analysis(Values):
    """When two filters, and what the paper derives and what it is, count as equal."""

    equal_within: Annotated[
        Positive, Field(description="difference of equal estimates, relative to the errors")
    ]
    orthogonal_within: Annotated[
        Positive, Field(description="correlation of an error and a y that count as orthogonal")
    ]
    covariance_within: Annotated[
        Positive, Field(description="share by which a claimed error variance may be off")
    ]


def _measurement(truth: np.ndarray, parameters: Parameters) -> np.ndarray:
    """C x(k), (trials, steps + 1)."""
    return (truth * np.array(parameters.measurement_row)).sum(axis=-1)


class LinearDelays(Study):
    """A stable plant of two states, one scalar measurement, packets at most N steps late.

    The filters of the paper are linear; each of them sees the same packets.
    """

    Parameters = Parameters
    Analysis = Analysis
    best_filters = MappingProxyType({"genie": "delays known", "sun": "linear filters"})
    judged_components = MappingProxyType({"state": (0, 1)})
    systems_per_block = 1000

    def topics(self, parameters: Parameters) -> dict[str, tuple[str, ...]]:
        flags = packet_delays.flags_per_step(parameters.packet_bound, lossy=False)
        return {
            "/truth": COMPONENTS,
            "/sensor": ("z",),
            "/received": ("y", "uncertain"),
            "/network": (*(f"gamma_{i}" for i in range(flags)), "delay"),
        }

    def simulate(self, parameters: Parameters, streams: StreamsOf) -> dict[str, np.ndarray]:
        steps, bound = parameters.steps, parameters.packet_bound
        entry = np.array(parameters.process_noise_entry)
        scale = np.sqrt(parameters.process_noise_variance)
        noise = scale * streams("process").standard_normal(steps)[:, :, None] * entry
        truth = linear_plant.trajectory(
            np.array(parameters.true_initial_state), noise, parameters.sine_period
        )
        v = np.sqrt(parameters.measurement_variance) * streams("sensor").standard_normal(steps + 1)
        z = _measurement(truth, parameters) + v
        flags = packet_delays.arrival_flags(
            streams("network").uniform(
                packet_delays.flags_per_step(bound, lossy=False), steps + 1
            ),  # one flag after the other: a smaller N shares its flags with a larger one
            parameters.arrival_probability,
        )
        delay = packet_delays.delays(flags, bound)
        y = packet_delays.received(z, v, delay)
        uncertain = np.where(flags[:, 0] == 1, z, v)  # the channel of Nahi (1969)
        return {
            "/truth": truth,
            "/sensor": z[:, :, None],
            "/received": np.stack([y, uncertain], axis=-1),
            "/network": np.concatenate(
                [np.moveaxis(flags, 1, -1), delay[:, :, None].astype(float)], axis=-1
            ),
        }

    def derived(self, parameters: Parameters) -> Fields:
        return {"/sensor": self.topics(parameters)["/sensor"]}

    def recomputed(self, log: Log) -> dict[str, np.ndarray]:
        """z of the uncertain channel: itself where it arrives, else with the noise v that does."""
        uncertain = log.field("/received", "uncertain")
        measured = _measurement(log.values["/truth"], log.parameters)
        arrived = log.field("/network", "gamma_0") == 1
        return {"/sensor": np.where(arrived, uncertain, measured + uncertain)[:, :, None]}

    def model(self, parameters: Parameters) -> LinearModel:
        entry = np.array(parameters.process_noise_entry)
        return LinearModel(
            transition_matrix=lambda k: linear_plant.transition_matrix(k, parameters.sine_period),
            measurement_row=np.array(parameters.measurement_row),
            process_covariance=parameters.process_noise_variance * np.outer(entry, entry),
            measurement_variance=parameters.measurement_variance,
            initial_mean=np.array(parameters.initial_estimate),
            initial_covariance=np.array(parameters.initial_covariance),
            initial_second_moment=np.array(parameters.initial_second_moment),
            network=DelayNetwork(parameters.arrival_probability, parameters.packet_bound),
        )

    def channel_topics(self, parameters: Parameters) -> dict[str, Fields]:
        return {
            "received": {"/received": ("y",)},
            "uncertain": {"/received": ("uncertain",)},
            "arrival": {"/network": ("delay",)},
            "delay": {"/network": ("delay",)},
        }

    def integers(self, parameters: Parameters) -> Integers:
        bound = parameters.packet_bound
        return {"/network": {"delay": (packet_delays.least_delay(bound, lossy=False), bound)}}

    def channels(self, log: Log, trials: slice) -> Recorded:
        delay = log.field("/network", "delay")[trials]
        return Recorded(
            received=log.field("/received", "y")[trials],
            uncertain=log.field("/received", "uncertain")[trials],
            arrival=(delay == 0).astype(float),
            delay=delay,
        )

    def rows(self, shards: Shards, analysis: Analysis) -> Rows:
        for i, component in enumerate(COMPONENTS):
            # Without k = 0, where every filter has the same estimate.
            squared = shards.each(lambda runs, i=i: (runs.error[:, 1:, i] ** 2).mean(axis=1))
            yield "mse", component, metrics.mean(squared)
            yield "rmse", component, metrics.root_mean(squared)
            claimed = shards.first.claimed
            if claimed is not None and claimed.ndim == 2:  # the same in every trial
                yield "claimed_mse", component, metrics.exact(claimed[1:, i].mean())
            elif claimed is not None:
                variances = shards.each(lambda runs, i=i: _claimed(runs)[:, 1:, i].mean(axis=1))
                yield "claimed_mse", component, metrics.mean(variances)

    def curves(self, shards: Shards) -> Rows:
        for i, component in enumerate(COMPONENTS):
            squared = shards.each(lambda runs, i=i: runs.error[:, :, i] ** 2)
            yield "rmse", component, metrics.root_mean(squared)


def _claimed(runs: Runs) -> np.ndarray:
    """Claimed variances of a filter that claims some, (trials, steps, 2)."""
    assert runs.claimed is not None
    return runs.claimed


STUDY = LinearDelays()
