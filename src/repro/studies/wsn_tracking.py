"""Target tracking in a wireless sensor network with packet delays (Liu, Xu, Shi 2012, Sec. 4.2)."""

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from repro.logs import Log
from repro.models import DelayNetwork, Model, coordinated_turn
from repro.network import packet_delays
from repro.network.tasking import ScheduledRanges
from repro.parameters.values import (
    Covariance5,
    NotNegative,
    PointParameters,
    Positive,
    Probability,
    Row5,
    Values,
)
from repro.statistics import metrics
from repro.statistics.runs import Runs
from repro.statistics.shards import Shards
from repro.studies import Rows, Study

STATE = ("px", "py", "vx", "vy", "omega")


class Parameters(PointParameters):
    """Values of one point."""

    field_side: Positive
    sensors: Annotated[int, Field(ge=1)]
    layout: Literal["redrawn", "fixed"]
    fixed_layout: Annotated[tuple[tuple[Probability, Probability], ...], Field(min_length=1)]
    sampling_time: Positive | Literal["k"]
    initial_estimate: Row5
    initial_covariance: Covariance5
    true_initial_state: Literal["estimate", "drawn"]
    true_turn_rate_variance: NotNegative
    turn_rate_variance: NotNegative
    measurement_variance: Positive
    channel: Literal["lossy", "eq2"]
    packet_bound: Annotated[int, Field(ge=0)]
    arrival_probability: Probability
    scheduled_on: Literal["predicted estimate", "true position"]


class Analysis(Values):
    """When a run has lost its target."""

    lost_above: Annotated[Positive, Field(description="m, largest error of a lost run")]


def _lossy(parameters: Parameters) -> bool:
    return parameters.channel == "lossy"


def _time(parameters: Parameters, k: int) -> float:
    """T of the step k -> k+1; the printed angle "k omega(k)" taken literally is the reading "k"."""
    return float(k) if parameters.sampling_time == "k" else parameters.sampling_time


def _trajectory(parameters: Parameters, streams) -> np.ndarray:
    steps = parameters.steps
    prior, process = streams("prior"), streams("process")
    truth = np.empty((len(prior), steps + 1, len(STATE)))
    truth[:, 0] = parameters.initial_estimate
    if parameters.true_initial_state == "drawn":
        root = np.linalg.cholesky(parameters.initial_covariance)
        truth[:, 0] += np.matvec(root, prior.standard_normal(len(STATE)))
    turn = np.sqrt(parameters.true_turn_rate_variance) * process.standard_normal(steps)
    for k in range(steps):
        truth[:, k + 1] = coordinated_turn.transition(truth[:, k], _time(parameters, k))
        truth[:, k + 1, 4] += turn[:, k]
    return truth


def positions(log) -> np.ndarray:
    """Sensor positions of each trial, (trials, sensors, 2), in m."""
    field = log.values["/field"]
    return field.reshape(len(field), -1, 2)


def position_error(runs) -> np.ndarray:
    """Er(k) of Sec. 4.2.2 with xh(k|k), (trials, steps + 1), in m."""
    return np.hypot(runs.error[:, :, 0], runs.error[:, :, 1])


class WsnTracking(Study):
    """..."""

    Parameters = Parameters
    Analysis = Analysis
    trajectory = (("px", "py"),)

    def topics(self, parameters: Parameters) -> dict[str, tuple[str, ...]]:
        sensors = range(1, parameters.sensors + 1)
        flags = packet_delays.flags_per_step(parameters.packet_bound, _lossy(parameters))
        return {
            "/truth": STATE,
            "/field": tuple(f"{axis}_{s}" for s in sensors for axis in ("x", "y")),
            "/sensor": ("noise", *(f"range_{s}" for s in sensors)),
            "/received": ("origin", "without_packet"),
            "/network": (*(f"gamma_{i}" for i in range(flags)), "delay"),
        }

    def simulate(self, parameters: Parameters, streams) -> dict[str, np.ndarray]:
        steps, bound = parameters.steps, parameters.packet_bound
        truth = _trajectory(parameters, streams)
        sensor = streams("sensor")
        # One sensor measures in a step, so one noise value a step serves whichever it is.
        v = np.sqrt(parameters.measurement_variance) * sensor.standard_normal(steps + 1)
        positions = parameters.field_side * sensor.uniform(parameters.sensors, 2)
        if parameters.layout == "fixed":
            positions[:] = parameters.field_side * np.array(parameters.fixed_layout)
        ranges = coordinated_turn.distance(truth[:, :, None], positions[:, None]) + v[:, :, None]
        flags = packet_delays.arrival_flags(
            streams("network").uniform(
                packet_delays.flags_per_step(bound, _lossy(parameters)), steps + 1
            ),  # flag by flag: N = 0, 1 and 2 share theirs
            parameters.arrival_probability,
        )
        delay = packet_delays.delays(flags, bound)
        received = [packet_delays.origins(delay), packet_delays.value_without_packet(v, delay)]
        return {
            "/truth": truth,
            "/field": positions.reshape(len(positions), 1, -1),
            "/sensor": np.concatenate([v[:, :, None], ranges], axis=-1),
            "/received": np.stack(received, axis=-1).astype(float),
            "/network": np.concatenate(
                [np.moveaxis(flags, 1, -1), delay[:, :, None].astype(float)], axis=-1
            ),
        }

    def model(self, parameters: Parameters) -> Model:
        process_covariance = np.zeros((len(STATE), len(STATE)))
        process_covariance[4, 4] = parameters.turn_rate_variance
        return Model(
            transition=lambda x, k: coordinated_turn.transition(x, _time(parameters, k)),
            transition_jacobian=lambda x, k: coordinated_turn.transition_jacobian(
                x, _time(parameters, k)
            ),
            measurement=lambda x, sensor: coordinated_turn.distance(x, sensor)[..., None],
            measurement_jacobian=coordinated_turn.distance_jacobian,
            process_covariance=process_covariance,
            measurement_covariance=np.array([[parameters.measurement_variance]]),
            initial_mean=np.array(parameters.initial_estimate, dtype=float),
            initial_covariance=np.array(parameters.initial_covariance),
            network=DelayNetwork(parameters.arrival_probability, parameters.packet_bound),
        )

    def channels(self, log: Log, trials: slice) -> ScheduledRanges:
        parameters = log.parameters
        delay = log.field("/network", "delay")[trials]
        on_truth = parameters.scheduled_on == "true position"
        return ScheduledRanges(
            positions=positions(log)[trials],
            ranges=log.values["/sensor"][trials, :, 1:],
            origin=log.field("/received", "origin")[trials],
            without_packet=log.field("/received", "without_packet")[trials],
            offered={"arrival": (delay == 0).astype(float), "delay": delay},
            first=np.array(parameters.initial_estimate[:2], dtype=float),
            bound=parameters.packet_bound,
            true_positions=log.values["/truth"][trials, :, :2] if on_truth else None,
        )

    def lost(self, runs: Runs, analysis: Analysis) -> np.ndarray:
        """Which runs lose the target, (trials,)."""
        return (position_error(runs)[:, 1:] > analysis.lost_above).any(axis=1)

    def rows(self, shards: Shards, analysis) -> Rows:
        mean_error = shards.each(lambda runs: position_error(runs)[:, 1:].mean(axis=1))
        yield "saee", "position", metrics.mean(mean_error)
        largest_error = shards.each(lambda runs: position_error(runs)[:, 1:].max(axis=1))
        yield "max_error", "position", metrics.mean(largest_error)

    def curves(self, shards: Shards) -> Rows:
        yield "error", "position", metrics.mean(shards.each(position_error))


STUDY = WsnTracking()
