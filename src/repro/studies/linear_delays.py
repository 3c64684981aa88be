"""The linear example with packet delays (Liu, Xu, Shi 2012, Sec. 4.1; Figures 1, 2)."""

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
)
from repro.statistics import metrics
from repro.statistics.shards import Shards
from repro.studies import Rows, Study

COMPONENTS = ("x1", "x2")


class Parameters(PointParameters):
    """Values of one point."""

    process_noise_entry: Pair
    process_noise_variance: NotNegative
    measurement_row: Pair
    measurement_variance: Positive
    sine_period: Positive
    packet_bound: Annotated[int, Field(ge=1)]
    arrival_probability: Probability
    true_initial_state: Pair
    initial_estimate: Pair
    initial_covariance: Covariance2
    initial_second_moment: Covariance2


class LinearDelays(Study):
    """..."""

    Parameters = Parameters

    def topics(self, parameters: Parameters) -> dict[str, tuple[str, ...]]:
        flags = packet_delays.flags_per_step(parameters.packet_bound, lossy=False)
        return {
            "/truth": COMPONENTS,
            "/sensor": ("z",),
            "/received": ("y", "uncertain"),
            "/network": (*(f"gamma_{i}" for i in range(flags)), "delay"),
        }

    def simulate(self, parameters: Parameters, streams) -> dict[str, np.ndarray]:
        steps, bound = parameters.steps, parameters.packet_bound
        entry = np.array(parameters.process_noise_entry)
        scale = np.sqrt(parameters.process_noise_variance)
        noise = scale * streams("process").standard_normal(steps)[:, :, None] * entry
        truth = linear_plant.trajectory(
            parameters.true_initial_state, noise, parameters.sine_period
        )
        v = np.sqrt(parameters.measurement_variance) * streams("sensor").standard_normal(steps + 1)
        z = np.vecdot(truth, np.array(parameters.measurement_row)) + v
        flags = packet_delays.arrival_flags(
            streams("network").uniform(
                packet_delays.flags_per_step(bound, lossy=False), steps + 1
            ),  # flag by flag: a smaller N shares its flags with a larger one
            parameters.arrival_probability,
        )
        delay = packet_delays.delays(flags, bound)
        y = packet_delays.received(z, v, delay)
        uncertain = np.where(flags[:, 0] == 1, z, v)  # the channel of reference [2]
        return {
            "/truth": truth,
            "/sensor": z[:, :, None],
            "/received": np.stack([y, uncertain], axis=-1),
            "/network": np.concatenate(
                [np.moveaxis(flags, 1, -1), delay[:, :, None].astype(float)], axis=-1
            ),
        }

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

    def channels(self, log: Log, trials: slice) -> Recorded:
        delay = log.field("/network", "delay")[trials]
        return Recorded(
            received=log.field("/received", "y")[trials],
            uncertain=log.field("/received", "uncertain")[trials],
            arrival=(delay == 0).astype(float),
            delay=delay,
        )

    def rows(self, shards: Shards, analysis) -> Rows:
        for i, component in enumerate(COMPONENTS):
            # Over k = 1 ... 300.
            squared = shards.each(lambda runs, i=i: (runs.error[:, 1:, i] ** 2).mean(axis=1))
            yield "mse", component, metrics.mean(squared)
            yield "rmse", component, metrics.root_mean(squared)
            claimed = shards.first.claimed
            if claimed is not None and claimed.ndim == 2:  # the same in every trial
                yield "claimed_mse", component, metrics.exact(claimed[1:, i].mean())
            elif claimed is not None:
                of_each = shards.each(lambda runs, i=i: runs.claimed[:, 1:, i].mean(axis=1))
                yield "claimed_mse", component, metrics.mean(of_each)

    def curves(self, shards: Shards) -> Rows:
        for i, component in enumerate(COMPONENTS):
            squared = shards.each(lambda runs, i=i: runs.error[:, :, i] ** 2)
            yield "rmse", component, metrics.root_mean(squared)


STUDY = LinearDelays()
