"""What the tracking studies of Song et al., Sec. IV-B, share in two and three dimensions."""

from typing import Annotated, Any, Self

import numpy as np
from pydantic import Field, model_validator

from repro.kernels.normals import standard_normal
from repro.models import rss
from repro.models.sensor_network import GaussianNoise, SensorNetwork
from repro.parameters.values import Positive, Values, at_most
from repro.statistics.runs import Runs
from repro.studies import StreamsOf
from repro.studies.families import harvesting_sensors
from repro.studies.families.harvesting_sensors import HarvestingParameters, HarvestingStudy


class SignalStrengthParameters(HarvestingParameters):
    """What the studies in two and three dimensions have in common."""

    sampling_time: Positive
    acceleration_variance: Positive
    reference_power: float
    reference_distance: Positive
    path_loss_exponent: Positive
    sensors: Annotated[int, Field(ge=1)]
    sensor_positions: Any
    measurement_variances: Annotated[tuple[Positive, ...], Field(min_length=1)]
    channel_variance: Positive
    true_initial_state: Any

    @model_validator(mode="after")
    def _every_sensor_has_place_and_noise(self) -> Self:
        for name in ("sensor_positions", "measurement_variances"):
            at_most("sensors", self.sensors, name, len(getattr(self, name)))
        return self


class Analysis(Values):
    """When a run has lost its target."""

    lost_above: Annotated[
        Positive, Field(description="m, rms position error over the last steps of a lost run")
    ]
    lost_last_steps: Annotated[int, Field(ge=1, description="steps over which it is taken")]


class SignalStrengthStudy(HarvestingStudy):
    """Tracking by received signal strength."""

    Analysis = Analysis

    def period(self, parameters: SignalStrengthParameters) -> float:
        return parameters.sampling_time

    def simulate(
        self, parameters: SignalStrengthParameters, streams: StreamsOf
    ) -> dict[str, np.ndarray]:
        steps, n = parameters.steps, len(parameters.true_initial_state)
        time, root = _motion(parameters)
        normals = streams("process").standard_normal(steps, n)
        truth = np.empty((len(normals), n, steps + 1))
        truth[:, :, 0] = parameters.true_initial_state
        for k in range(steps):
            truth[:, :, k + 1] = rss.move(truth[:, :, k].copy(), normals[:, k], time, root)
        sensors = range(parameters.sensors)
        levels = np.stack([level(parameters, truth, i) for i in sensors], axis=1)
        return harvesting_sensors.measured(
            np.moveaxis(truth, 1, -1), levels, parameters, noise(parameters), streams
        )

    def lost(self, runs: Runs, analysis: Analysis) -> np.ndarray:
        """Which runs have lost the target, (trials,)."""
        axes = range(0, runs.error.shape[-1], 2)
        last = harvesting_sensors.squared(runs, axes)[:, -analysis.lost_last_steps :]
        return np.sqrt(last.mean(axis=1)) > analysis.lost_above


def state(dimensions: int) -> tuple[str, ...]:
    return tuple(f"{kind}_{axis}" for axis in "xyz"[:dimensions] for kind in ("s", "v"))


def components(dimensions: int) -> dict[str, range]:
    return {
        "position": range(0, 2 * dimensions, 2),
        "velocity": range(1, 2 * dimensions, 2),
    }


def noise(parameters: SignalStrengthParameters) -> GaussianNoise:
    variances = np.array(parameters.measurement_variances[: parameters.sensors])
    return GaussianNoise(variances, parameters.channel_variance)


def positions(parameters: SignalStrengthParameters) -> np.ndarray:
    """Positions of the sensors in use, (N, axes), in m."""
    return np.array(parameters.sensor_positions, dtype=float)[: parameters.sensors]


def level(parameters: SignalStrengthParameters, x: np.ndarray, i: int) -> np.ndarray:
    """h^i(x) in dBm of states (trials, n, ...)."""
    return rss.level(
        x,
        positions(parameters)[i],
        parameters.reference_power,
        parameters.path_loss_exponent,
        parameters.reference_distance,
    )


def saturated(log, i: int) -> np.ndarray:
    """Where the output of sensor i is saturated, gamma = 1 and |h| > kappa, (trials, steps + 1)."""
    levels = level(log.parameters, np.moveaxis(log.values["/truth"], 2, 1), i)
    gamma = log.field("/network", f"saturation_{i + 1}")
    return (gamma == 1) & (np.abs(levels) > log.parameters.saturation_level)


def model(parameters: SignalStrengthParameters, draw_prior) -> SensorNetwork:
    time, root = _motion(parameters)
    initial = np.array(parameters.true_initial_state, dtype=float)

    def move(x, k, streams):
        return rss.move(x, standard_normal(streams, *x.shape[1:]), time, root)

    return SensorNetwork(
        initial_mean=initial,
        sensors=parameters.sensors,
        steps=parameters.steps,
        draw_prior=draw_prior,
        move=move,
        level=lambda x, i: level(parameters, x, i),
        noise=noise(parameters),
        saturation=harvesting_sensors.saturation_of(parameters),
        energy=harvesting_sensors.queue(parameters),
        plant=rss.SignalStrength(
            time,
            root,
            positions(parameters),
            parameters.reference_power,
            parameters.path_loss_exponent,
            parameters.reference_distance,
        ),
    )


def _motion(parameters: SignalStrengthParameters) -> tuple[float, np.ndarray]:
    time = parameters.sampling_time
    return time, rss.process_root(time, parameters.acceleration_variance)
