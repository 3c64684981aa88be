"""The quadrotor in closed loop [unknown_losses Sec. VI-C, Table III, Figs. 6-10]."""

from types import MappingProxyType
from typing import NoReturn

import numpy as np

from repro.control.flight import Flight, System
from repro.logs import Log
from repro.models import Model, quadrotor
from repro.models.quadrotor import ANGLES, POSITION, STATE, VELOCITY
from repro.network import losses
from repro.statistics import metrics
from repro.statistics.runs import Runs
from repro.statistics.shards import Shards
from repro.studies import ClosedLoop, Fields, Rows, StreamsOf
from repro.studies.families.quadrotor_parameters import (
    Analysis,
    Parameters,
    airframe,
    controller,
    motor,
    per_component,
    reference,
)


def _start(parameters: Parameters) -> np.ndarray:
    """At rest on the first point of the path."""
    state = np.zeros(len(STATE))
    state[POSITION] = reference(parameters)[0, :3]
    return state


def _wrapped(received: np.ndarray, expected: np.ndarray) -> np.ndarray:
    """Received minus expected, differences of angles wrapped to [-pi, pi)."""
    difference = received - expected
    angles = difference[..., ANGLES]
    angles -= 2 * np.pi * np.floor((angles + np.pi) / (2 * np.pi))
    return difference


def _needs_rotor_speeds(x: np.ndarray, k: int) -> NoReturn:
    raise TypeError("the quadrotor moves by its rotor speeds: call `linearised` with them")


def flying(runs: Runs) -> np.ndarray:
    """Which steps were flown, (flights, steps)."""
    return np.arange(runs.error.shape[1]) < runs.recorded["end"][:, None]


def over_flight(runs: Runs, per_step: np.ndarray) -> np.ndarray:
    """Mean of (flights, steps) over the steps that were flown, (flights,)."""
    flown = flying(runs)
    return np.where(flown, per_step, 0.0).sum(axis=1) / flown.sum(axis=1)


def squared_distance(runs: Runs) -> np.ndarray:
    """Mean squared distance to the reference over each flight, (flights,), in m^2."""
    return over_flight(runs, runs.recorded["distance"] ** 2)


def ended(runs: Runs) -> np.ndarray:
    """Which flights tumbled, or left, before the last step, (flights,)."""
    return runs.recorded["end"] < runs.error.shape[1]


def detected(runs: Runs, gamma: int) -> np.ndarray:
    """Share of the steps with this gamma at which the filter infers it, (flights,)."""
    steps = flying(runs) & (runs.recorded["gamma"] == gamma)
    right = runs.recorded["arrived"] == bool(gamma)
    return (steps & right).sum(axis=1) / np.maximum(steps.sum(axis=1), 1)


def squared_error(runs: Runs, components: slice) -> np.ndarray:
    """Squared error of a kind of components, mean over each flight, (flights,)."""
    return over_flight(runs, (runs.error[..., components] ** 2).sum(axis=-1))


def altitude(runs: Runs) -> np.ndarray:
    """Mean over each flight, (flights,), in m."""
    return over_flight(runs, runs.recorded["position"][..., 2])


class Quadrotor(ClosedLoop):
    """Flights along a path on the estimates of each filter, under the same noise and losses.

    [unknown_losses Figs. 8-10].
    """

    Parameters = Parameters
    Analysis = Analysis
    systems_per_block = 1200
    keeps_inferred_arrivals = True
    keeps_claimed_variance = False  # no table shows them
    judged_components = MappingProxyType(
        {"position": (9, 10, 11), "velocity": (6, 7, 8), "angles": (3, 4, 5)}
    )
    error_unit = "m"
    topics_between_steps = ("/process", "/throttle")
    trajectory = (("x", "y"), ("x", "z"))

    def topics(self, parameters: Parameters) -> Fields:
        """Fields of the disturbances; the flights under them depend on the filter."""
        return {
            "/process": tuple(f"w_{name}" for name in STATE),
            "/sensor": tuple(f"v_{name}" for name in STATE),
            "/network": ("gamma",),
        }

    def period(self, parameters: Parameters) -> float:
        return parameters.period

    def first_step(self, parameters: Parameters) -> int:
        return 0  # y(0) is used: Algorithms 1-3

    def simulate(self, parameters: Parameters, streams: StreamsOf) -> dict[str, np.ndarray]:
        steps, n = parameters.steps, len(STATE)
        gamma = losses.arrivals(
            streams("network").uniform(steps + 1), losses.bernoulli(parameters.loss_probability)
        )
        process = per_component(parameters.process_deviations)
        noise = per_component(parameters.measurement_deviations)
        return {
            "/process": process * streams("process").standard_normal(steps, n),
            "/sensor": noise * streams("sensor").standard_normal(steps + 1, n),
            "/network": gamma[:, :, None],
        }

    def model(self, parameters: Parameters) -> Model:
        frame, step = airframe(parameters), parameters.period
        measured = [{i: 1.0} for i in range(len(STATE))]
        process = per_component(parameters.process_deviations)
        process[POSITION] = parameters.believed_position_deviation
        return Model(
            transition=_needs_rotor_speeds,
            transition_jacobian=_needs_rotor_speeds,
            measurement=lambda x, sensor: x,
            measurement_jacobian=lambda x, sensor: measured,
            process_covariance=np.diag(process**2),
            measurement_covariance=np.diag(per_component(parameters.measurement_deviations) ** 2),
            initial_mean=_start(parameters),
            initial_covariance=np.diag(per_component(parameters.initial_deviations) ** 2),
            network=losses.bernoulli(parameters.loss_probability),
            innovation=_wrapped,
            linearised=lambda x, speeds, k: quadrotor.linearised(frame, x, speeds, step),
        )

    def channels(self, log: Log, trials: slice) -> Flight:
        parameters = log.parameters
        start = _start(parameters)
        system = System(
            airframe(parameters),
            motor(parameters),
            controller(parameters),
            parameters.period,
            tilt_limit=np.deg2rad(parameters.tumbled_above_deg),
            range_limit=parameters.left_beyond + 4 * start[11],
        )
        return Flight(
            system,
            process=log.values["/process"][trials],
            noise=log.values["/sensor"][trials],
            gamma=log.field("/network", "gamma")[trials],
            reference=reference(parameters),
            start=start,
            start_speed=parameters.start_speed,
        )

    def flight(self, log: Log, estimate: np.ndarray, runs: Runs) -> Log:
        """The log of the flights on a filter's estimates (flights, steps, 12)."""
        wanted = reference(log.parameters)
        return log._replace(
            fields={
                "/truth": STATE,
                "/received": STATE,
                "/estimate": STATE,
                "/reference": ("x", "y", "z", "psi"),
                "/throttle": tuple(f"motor_{i}" for i in range(1, 5)),
            },
            values=(runs.flown or {})
            | {
                "/estimate": estimate,
                "/reference": np.broadcast_to(wanted, (len(estimate), *wanted.shape)),
            },
        )

    def squared_error(self, runs: Runs) -> np.ndarray:
        """Squared distance to the reference, (flights, steps), in m^2."""
        return runs.recorded["distance"] ** 2

    def counted(self, runs: Runs) -> np.ndarray:
        """The steps that were flown, (flights, steps) of flags."""
        return flying(runs) & super().counted(runs)

    def lost(self, runs: Runs, analysis: Analysis) -> np.ndarray:
        """Which flights ended before the last step, (flights,)."""
        return ended(runs)

    def rows(self, shards: Shards, analysis: Analysis) -> Rows:
        yield "rmse", "tracking", metrics.root_mean(shards.each(squared_distance))
        for component, of in (("position", POSITION), ("velocity", VELOCITY), ("angles", ANGLES)):
            squared = shards.each(lambda runs, of=of: squared_error(runs, of))
            yield "rmse", component, metrics.root_mean(squared)
        yield "tumbled", "flight", metrics.mean(shards.each(lambda runs: ended(runs).astype(float)))
        end_time = shards.each(lambda runs: runs.recorded["end_time"])
        yield "end_time", "flight", metrics.mean(end_time)
        if "arrived" in shards.first.recorded:
            for component, gamma in (("losses", 0), ("arrivals", 1)):
                shares = shards.each(lambda runs, gamma=gamma: detected(runs, gamma))
                yield "detected", component, metrics.mean(shares)
        yield "altitude", "Z", metrics.mean(shards.each(altitude))

    def curves(self, shards: Shards) -> Rows:
        distance = shards.each(lambda runs: runs.recorded["distance"])
        yield "distance", "tracking", metrics.mean(distance)


STUDY = Quadrotor()
