"""What the three studies of [energy_harvesting] share: parameters, network, logs and metrics."""

from collections.abc import Mapping, Sequence
from typing import Any, ClassVar, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from repro.logs import Log
from repro.models.sensor_network import Noise
from repro.network import energy_harvesting, saturation
from repro.network.channels import Recorded
from repro.network.energy_harvesting import EnergyQueue
from repro.network.saturation import Saturation
from repro.parameters.settings import Bootstrap
from repro.parameters.values import (
    PointParameters,
    Positive,
    Probability,
    StochasticMatrix,
    Values,
    at_most,
)
from repro.statistics import metrics
from repro.statistics.runs import Runs
from repro.statistics.shards import Columns, Shards
from repro.studies import Fields, Rows, StreamsOf, Study


class HarvestingParameters(PointParameters):
    """Saturation, battery and harvest, which are alike at all sensors."""

    saturation_probability: Probability = Field(
        description="probability gbar that a sensor saturates at a step"
    )
    saturation_level: Positive = Field(
        description="kappa_max, in the unit of the measurement (rss_2d, rss_3d: dBm)"
    )
    initial_energy: int = Field(ge=1, description="energy E(0) of a battery, units")
    energy_capacity: int = Field(ge=1, description="largest energy Ebar of a battery, units")
    harvest_transition: StochasticMatrix = Field(
        description="Pi, row u: probabilities of H(k+1) = 0, 1, ... units given H(k) = u"
    )
    initial_harvest: Literal["uniform", "zero", "full", "stationary"] = Field(
        description="law of the harvest H(0)"
    )
    initial_truth: Literal["printed", "drawn"] = Field(
        description="whether x(0) of a run is true_initial_state, or drawn from the filters' prior"
    )

    @model_validator(mode="after")
    def _battery_holds_its_energy(self) -> Self:
        at_most("initial_energy", self.initial_energy, "energy_capacity", self.energy_capacity)
        return self


class ExactnessAnalysis(Values):
    """When two numbers are equal, and on what the reductions of PF-ROSS-EH are tested."""

    rounding: Positive = Field(description="largest difference of numbers that are equal")
    reduction_trials: int = Field(ge=1, description="trials on which the reductions are tested")
    reduction_settings: Bootstrap = Field(description="settings of both filters in that test")


class HarvestingStudy(Study):
    """A study of saturating, energy-harvesting sensors."""

    components: ClassVar[Mapping[str, Sequence[int]]]  # name -> state components of one error

    def first_states(self, parameters: Any, streams: StreamsOf) -> np.ndarray:
        """x(0), of every trial (trials, n) if it is drawn, else (n,)."""
        if parameters.initial_truth == "drawn":
            return self.model(parameters).draw_prior(streams("truth"), 1)[:, :, 0]
        return np.atleast_1d(parameters.true_initial_state)

    def channel_topics(self, parameters: Any) -> dict[str, Fields]:
        topics = self.topics(parameters)
        return {
            "received": {"/received": topics["/received"]},
            "ideal": {"/ideal": topics["/ideal"]},
        }

    def channels(self, log: Log, trials: slice) -> Recorded:
        return Recorded(
            received=log.values["/received"][trials],
            ideal=log.values["/ideal"][trials],
        )

    def rows(self, shards: Shards, analysis: Any) -> Rows:
        """Mean over k = 1 ... K of RMSE(k), of all runs and of those that are not lost."""
        lost = None
        if self.lost(shards.first, analysis) is not None:
            lost = np.asarray(shards.each(lambda runs: np.asarray(self.lost(runs, analysis))))
        for name, axes in self.components.items():
            of_all = squared_after_start(shards, axes)
            yield "rmse", name, metrics.statistic(metrics.roots_over_steps(of_all))
            if lost is not None and not lost.all():
                of_tracking = metrics.roots_over_steps(of_all.only(~lost))
                yield "rmse_not_lost", name, metrics.statistic(of_tracking)

    def curves(self, shards: Shards) -> Rows:
        """RMSE(k) [energy_harvesting Sec. IV-B]: the root of the mean over the trials."""
        for name, axes in self.components.items():
            of_all = shards.each(lambda runs, axes=axes: squared(runs, axes))
            yield "rmse", name, metrics.root_mean(of_all)


def topics(state: tuple[str, ...], sensors: int) -> Fields:
    """Fields of each topic; those of the sensors are numbered from 1."""

    def each(*names: str) -> tuple[str, ...]:
        return tuple(f"{name}_{i}" for i in range(1, sensors + 1) for name in names)

    return {
        "/truth": state,
        "/sensor": each("y"),
        "/received": each("z"),
        "/network": each("energy", "harvest", "saturation", "sent"),
        "/ideal": each("z"),
    }


def queue(parameters: HarvestingParameters) -> EnergyQueue:
    """Battery and harvest of a sensor."""
    transition = np.array(parameters.harvest_transition)
    return EnergyQueue(
        transition,
        energy_harvesting.initial_harvest(parameters.initial_harvest, transition),
        parameters.initial_energy,
        parameters.energy_capacity,
    )


def saturation_of(parameters: HarvestingParameters) -> Saturation:
    """Saturation of a sensor."""
    return Saturation(parameters.saturation_probability, parameters.saturation_level)


def measured(
    truth: np.ndarray,
    levels: np.ndarray,
    parameters: HarvestingParameters,
    noise: Noise,
    streams: StreamsOf,
) -> dict[str, np.ndarray]:
    """All topics from the truth (trials, steps, n) and noise-free levels h (trials, N, steps)."""
    trials, sensors, steps = levels.shape
    # Drawn sensor by sensor, so that networks of any size share the draws of their first sensors.
    uniforms = streams("network").uniform(sensors, 2, steps)
    gamma = saturation.occurrences(uniforms[:, :, 0], parameters.saturation_probability)
    harvest = energy_harvesting.harvest(uniforms[:, :, 1], queue(parameters))
    energy = energy_harvesting.energy(harvest, queue(parameters))
    sent = energy > 0
    nu, n = noise.draw(streams("sensor"), steps)
    y = saturation.output(levels, gamma, saturation_of(parameters)) + nu  # (2)
    network = np.stack([energy, harvest, gamma, sent], axis=2).astype(float)
    return {
        "/truth": truth,
        "/sensor": np.moveaxis(y, 1, -1),
        "/received": np.moveaxis(np.where(sent, y, 0.0) + n, 1, -1),  # (7)
        "/network": np.moveaxis(network.reshape(trials, sensors * 4, steps), 1, -1),
        "/ideal": np.moveaxis(levels + nu + n, 1, -1),
    }


def sent(log: Log) -> np.ndarray:
    """Whether each sensor transmits, (trials, steps + 1, N)."""
    sensors = log.values["/received"].shape[-1]
    of_each = [log.field("/network", f"sent_{i + 1}") for i in range(sensors)]
    return np.stack(of_each, axis=-1)


def squared(runs: Runs, axes: Sequence[int]) -> np.ndarray:
    """Squared error summed over the given components, (trials, steps + 1)."""
    return (runs.error[:, :, list(axes)] ** 2).sum(axis=-1)


def squared_after_start(shards: Shards, axes: Sequence[int]) -> Columns:
    """Squared errors of every run at k = 1 ... K, summed over the given components."""
    columns = shards.each(lambda runs: squared(runs, axes)[:, 1:])
    assert isinstance(columns, Columns)  # a quantity of every step
    return columns
