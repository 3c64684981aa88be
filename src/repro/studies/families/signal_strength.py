"""What the tracking studies of [energy_harvesting Sec. IV-B] share in two and three dimensions."""

from typing import Annotated, Generic, Self, TypeVar

import numpy as np
from pydantic import Field, model_validator

from repro.kernels import arrays
from repro.kernels.sensed_plants import SQUARED_DISTANCE_FLOOR
from repro.logs import Log
from repro.models import rss
from repro.models.sensor_network import DrawPrior, GaussianNoise, SensorNetwork
from repro.parameters.values import Positive, Probability, Values, at_most
from repro.statistics.runs import Runs
from repro.studies import StreamsOf
from repro.studies.families import harvesting_sensors
from repro.studies.families.harvesting_sensors import (
    HarvestingParameters,
    HarvestingStudy,
)
from repro.studies.families.information import Information, mean_information

Position = TypeVar("Position", bound=tuple[float, ...])
State = TypeVar("State", bound=tuple[float, ...])


class SignalStrengthParameters(HarvestingParameters, Generic[Position, State]):
    """Motion and sensors, for positions and states of either dimension."""

    sampling_time: Positive = Field(description="T, s")
    acceleration_variance: Positive = Field(
        description="Delta, intensity of the process noise, m^2/s^4 as printed"
    )
    reference_power: float = Field(description="level P_0 at the reference distance, dBm")
    reference_distance: Positive = Field(description="d_0, m")
    path_loss_exponent: Positive = Field(description="n_r, no unit")
    sensors: int = Field(ge=1, description="number N of sensors in use: the first of those given")
    sensor_positions: Annotated[tuple[Position, ...], Field(min_length=1)] = Field(
        description="position of each sensor, m"
    )
    measurement_variances: Annotated[tuple[Positive, ...], Field(min_length=1)] = Field(
        description="variance of the noise nu of each sensor, dBm^2"
    )
    channel_variance: Positive = Field(description="variance of the noise n of a channel, dBm^2")
    true_initial_state: State = Field(
        description="position and velocity at k = 0, axis by axis, m and m/s"
    )

    @model_validator(mode="after")
    def _every_sensor_has_place_and_noise(self) -> Self:
        for name in ("sensor_positions", "measurement_variances"):
            at_most("sensors", self.sensors, name, len(getattr(self, name)))
        return self


class SignalStrengthAnalysis(Values):
    """When a run has lost its target, and when too few runs are left to compare."""

    lost_above: Positive = Field(
        description="m, rms position error over the last steps of a lost run"
    )
    lost_last_steps: int = Field(ge=1, description="number of steps that this error is taken over")
    fewest_compared: int = Field(
        ge=1, description="runs that neither filter loses, below which their RMSE is not compared"
    )
    lost_margin: Probability = Field(
        description="share of the runs by which the more accurate filter may lose more"
    )
    much_better: float = Field(ge=1.0, description="factor between errors that `much` stands for")
    approaches_within: float = Field(
        gt=1.0, description="factor between errors that approach one another"
    )
    tracks_within: Positive = Field(
        description="m, rms position error over all steps of a run that tracks well"
    )
    tracks_share: Probability = Field(description="share of the runs that must track well")


class SignalStrengthStudy(HarvestingStudy):
    """Tracking by received signal strength."""

    Analysis = SignalStrengthAnalysis

    error_unit = "m"

    def period(self, parameters: SignalStrengthParameters) -> float:
        return parameters.sampling_time

    def simulate(
        self, parameters: SignalStrengthParameters, streams: StreamsOf
    ) -> dict[str, np.ndarray]:
        steps, n = parameters.steps, len(parameters.true_initial_state)
        time, root = _motion(parameters)
        normals = streams("process").standard_normal(steps, n)
        truth = np.empty((len(normals), n, steps + 1))
        truth[:, :, 0] = self.first_states(parameters, streams)
        for k in range(steps):
            truth[:, :, k + 1] = rss.move(truth[:, :, k], normals[:, k], time, root)
        sensors = range(parameters.sensors)
        levels = np.stack([level(parameters, truth, i) for i in sensors], axis=1)
        return harvesting_sensors.measured(
            np.moveaxis(truth, 1, -1), levels, parameters, noise(parameters), streams
        )

    def information(self, log: Log) -> Information | None:
        """A saturated output says nothing; the start is known, unless it is drawn: then None."""
        parameters, truth = log.parameters, log.values["/truth"]
        if parameters.initial_truth == "drawn":
            return None
        levels = np.moveaxis(truth, 2, 1)
        time, root = _motion(parameters)
        n, axes = truth.shape[2], truth.shape[2] // 2
        of_sensors = range(parameters.sensors)
        sent = harvesting_sensors.sent(log) > 0.5
        gamma = [log.field("/network", f"saturation_{i + 1}") > 0.5 for i in of_sensors]
        saturates = np.stack(gamma, axis=-1)
        informations = np.empty((truth.shape[1], 2 * parameters.sensors, n, n))
        variances = noise(parameters)
        for i in of_sensors:
            rows = gradient(parameters, truth, i)
            within = np.abs(level(parameters, levels, i)) <= parameters.saturation_level
            precision = 1.0 / (variances.measurement_variances[i] + variances.channel_variance)
            for k in range(truth.shape[1]):
                for j, of in (
                    (i, rows[:, k]),
                    (i + len(of_sensors), rows[:, k] * within[:, k, None]),
                ):
                    informations[k, j] = mean_information(of[:, None], np.array([precision]))
        return Information(
            np.kron(np.eye(axes), [[1.0, time], [0.0, 1.0]]),
            np.kron(np.eye(axes), (root[:, None] * root).sum(axis=-1)),
            np.zeros((n, n)),
            1,
            informations,
            np.concatenate([sent & ~saturates, sent & saturates], axis=-1),
        )

    def squared_error(self, runs: Runs) -> np.ndarray:
        """Squared position error at k = 1, 2, ..., (trials, steps), in m^2."""
        return harvesting_sensors.squared(runs, range(0, runs.error.shape[-1], 2))[:, 1:]

    def lost(self, runs: Runs, analysis: SignalStrengthAnalysis) -> np.ndarray:
        """Which runs have lost the target, (trials,)."""
        axes = range(0, runs.error.shape[-1], 2)
        last = harvesting_sensors.squared(runs, axes)[:, -analysis.lost_last_steps :]
        return np.sqrt(last.mean(axis=1)) > analysis.lost_above


def state(dimensions: int) -> tuple[str, ...]:
    """Names of the state's components."""
    return tuple(f"{kind}_{axis}" for axis in "xyz"[:dimensions] for kind in ("s", "v"))


def components(dimensions: int) -> dict[str, range]:
    """Components of the state that make up the errors in position and velocity."""
    return {
        "position": range(0, 2 * dimensions, 2),
        "velocity": range(1, 2 * dimensions, 2),
    }


def noise(parameters: SignalStrengthParameters) -> GaussianNoise:
    """Noises of the sensors in use and of their channels."""
    variances = np.array(parameters.measurement_variances[: parameters.sensors])
    return GaussianNoise(variances, parameters.channel_variance)


def positions(parameters: SignalStrengthParameters) -> np.ndarray:
    """Positions of the sensors in use, (N, axes), in m."""
    return np.array(parameters.sensor_positions, dtype=float)[: parameters.sensors]


def level(parameters: SignalStrengthParameters, x: np.ndarray, i: int) -> np.ndarray:
    """h^i(x) in dBm of states (trials, n, ...); i counts the sensors from 0."""
    return rss.level(
        x,
        positions(parameters)[i],
        parameters.reference_power,
        parameters.path_loss_exponent,
        parameters.reference_distance,
    )


def gradient(parameters: SignalStrengthParameters, truth: np.ndarray, i: int) -> np.ndarray:
    """Derivative of h^i in dBm at states (trials, steps, n), of the same shape."""
    offset = truth[..., 0::2] - positions(parameters)[i]
    squared = np.zeros(offset.shape[:-1])
    for axis in range(offset.shape[-1]):
        squared += offset[..., axis] ** 2
    rows = np.zeros(truth.shape)
    slope = -10.0 * parameters.path_loss_exponent / arrays.log(10.0)
    rows[..., 0::2] = slope * offset / np.maximum(squared, SQUARED_DISTANCE_FLOOR)[..., None]
    return rows


def saturated(log: Log, sensor: int) -> np.ndarray:
    """Where a sensor's output is saturated, gamma = 1 and |h| > kappa, (trials, steps + 1).

    As in the log and in the paper, the sensors are numbered from 1.
    """
    levels = level(log.parameters, np.moveaxis(log.values["/truth"], 2, 1), sensor - 1)
    gamma = log.field("/network", f"saturation_{sensor}")
    return (gamma == 1) & (np.abs(levels) > log.parameters.saturation_level)


def model(parameters: SignalStrengthParameters, draw_prior: DrawPrior) -> SensorNetwork:
    """What a filter knows, with the prior of one of the studies."""
    time, root = _motion(parameters)
    initial = np.array(parameters.true_initial_state, dtype=float)

    return SensorNetwork(
        initial_mean=initial,
        sensors=parameters.sensors,
        steps=parameters.steps,
        draw_prior=draw_prior,
        plant=rss.SignalStrength(
            time,
            root,
            positions(parameters),
            parameters.reference_power,
            parameters.path_loss_exponent,
            parameters.reference_distance,
        ),
        noise=noise(parameters),
        saturation=harvesting_sensors.saturation_of(parameters),
        energy=harvesting_sensors.queue(parameters),
    )


def _motion(parameters: SignalStrengthParameters) -> tuple[float, np.ndarray]:
    time = parameters.sampling_time
    return time, rss.process_root(time, parameters.acceleration_variance)
