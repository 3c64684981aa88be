"""What the three studies of Song et al. share: the sensors' network, logs, channels, metrics."""

from collections.abc import Mapping, Sequence
from typing import Annotated, Any, ClassVar, Literal, Self

import numpy as np
from pydantic import Field, model_validator

from repro.logs import Log
from repro.network import energy_harvesting, saturation
from repro.network.channels import Recorded
from repro.network.energy_harvesting import EnergyQueue
from repro.network.saturation import Saturation
from repro.parameters.values import (
    PointParameters,
    Positive,
    Probability,
    StochasticMatrix,
    at_most,
)
from repro.statistics import metrics
from repro.statistics.shards import Shards
from repro.studies import Rows, Study


class HarvestingParameters(PointParameters):
    """What the three studies have in common."""

    saturation_probability: Probability
    saturation_level: Positive
    initial_energy: Annotated[int, Field(ge=1)]
    energy_capacity: Annotated[int, Field(ge=1)]
    harvest_transition: StochasticMatrix
    initial_harvest: Literal["uniform", "zero", "full", "stationary"]

    @model_validator(mode="after")
    def _battery_holds_its_energy(self) -> Self:
        at_most("initial_energy", self.initial_energy, "energy_capacity", self.energy_capacity)
        return self


class HarvestingStudy(Study):
    """A study of saturating, energy-harvesting sensors."""

    components: ClassVar[Mapping[str, Sequence[int]]]  # of the state, whose error is one number

    def channels(self, log: Log, trials: slice) -> Recorded:
        return Recorded(
            received=log.values["/received"][trials],
            ideal=log.values["/ideal"][trials],
        )

    def rows(self, shards: Shards, analysis: Any) -> Rows:
        """Mean over k = 1 ... K of RMSE(k), of all runs and of those that are not lost."""
        knows_lost = self.lost(shards.first, analysis) is not None
        tracking = (
            ~shards.each(lambda runs: self.lost(runs, analysis))
            if knows_lost
            else np.array([False])
        )
        for name, axes in self.components.items():
            of_all = shards.each(lambda runs, axes=axes: squared(runs, axes)[:, 1:])
            yield "rmse", name, metrics.statistic(metrics.roots_over_steps(of_all))
            if tracking.any():
                of_tracking = metrics.roots_over_steps(of_all.only(tracking))
                yield "rmse_not_lost", name, metrics.statistic(of_tracking)

    def curves(self, shards: Shards) -> Rows:
        """RMSE(k) of Sec. IV-B: the root stands outside the mean over the trials."""
        for name, axes in self.components.items():
            of_all = shards.each(lambda runs, axes=axes: squared(runs, axes))
            yield "rmse", name, metrics.root_mean(of_all)


def topics(state: tuple[str, ...], sensors: int) -> dict[str, tuple[str, ...]]:
    def each(*names):
        return tuple(f"{name}_{i}" for i in range(1, sensors + 1) for name in names)

    return {
        "/truth": state,
        "/sensor": each("y"),
        "/received": each("z"),
        "/network": each("energy", "harvest", "saturation", "sent"),
        "/ideal": each("z"),
    }


def queue(parameters: HarvestingParameters) -> EnergyQueue:
    transition = np.array(parameters.harvest_transition)
    return EnergyQueue(
        transition,
        energy_harvesting.initial_harvest(parameters.initial_harvest, transition),
        parameters.initial_energy,
        parameters.energy_capacity,
    )


def saturation_of(parameters: HarvestingParameters) -> Saturation:
    return Saturation(parameters.saturation_probability, parameters.saturation_level)


def measured(
    truth: np.ndarray, levels: np.ndarray, parameters: HarvestingParameters, noise, streams
) -> dict:
    """All topics from the truth (trials, steps, n) and noise-free levels h (trials, N, steps)."""
    trials, sensors, steps = levels.shape
    # Sensor by sensor, so that a network of more sensors shares those of a smaller one.
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


def sent(log) -> np.ndarray:
    """Whether each sensor transmits, (trials, steps + 1, N)."""
    sensors = log.values["/received"].shape[-1]
    of_each = [log.field("/network", f"sent_{i + 1}") for i in range(sensors)]
    return np.stack(of_each, axis=-1)


def squared(runs, axes) -> np.ndarray:
    """Squared error summed over the given components, (trials, steps + 1)."""
    return (runs.error[:, :, list(axes)] ** 2).sum(axis=-1)
