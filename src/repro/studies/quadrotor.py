"""The quadrotor in closed loop (Zhang, You, Xie 2018, Sec. VI-C; Table III, Figs. 6-10)."""

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from repro.control import cascaded_pid, path
from repro.control.flight import Flight, System
from repro.logs import Log
from repro.models import Model, quadrotor
from repro.models.quadrotor import ANGLES, POSITION, STATE, VELOCITY
from repro.network import losses
from repro.parameters.values import (
    NotNegative,
    PointParameters,
    Positive,
    Probability,
    Triple,
)
from repro.statistics import metrics
from repro.statistics.runs import Runs
from repro.statistics.shards import Shards
from repro.studies import ClosedLoop, Rows


class Parameters(PointParameters):
    """Values of one point."""

    period: Positive
    mass: Positive
    gravity: Positive
    arm: Positive
    inertia: tuple[Positive, Positive, Positive]
    rotor_inertia: NotNegative
    thrust_coefficient: Positive
    torque_coefficient: Positive
    motor_time_constant: Positive
    motor_slope: Positive
    motor_offset: float
    least_throttle: Annotated[float, Field(ge=0, le=100)]
    velocity_gains: Triple
    roll_gains: Triple
    pitch_gains: Triple
    yaw_gains: Triple
    altitude_gains: Triple
    tilt_command_limit_deg: Positive
    integral_limit: Positive
    path_times: Annotated[tuple[NotNegative, ...], Field(min_length=2)]
    path_points: Annotated[tuple[Triple, ...], Field(min_length=2)]
    path_scale: Positive
    path_slowness: Positive
    start_speed: NotNegative
    measurement_deviations: tuple[Positive, Positive, Positive, Positive]
    process_deviations: tuple[NotNegative, NotNegative, NotNegative, NotNegative]
    believed_position_deviation: NotNegative
    initial_deviations: tuple[NotNegative, NotNegative, NotNegative, NotNegative]
    loss_process: Literal["Bernoulli"]
    loss_probability: Probability
    tumbled_above_deg: Positive
    left_beyond: Positive


def _per_component(deviations: tuple[float, float, float, float]) -> np.ndarray:
    """Standard deviations of rates, angles, velocity and position, of each component, (12,), SI."""
    rate, angle, velocity, position = deviations
    return np.repeat([np.deg2rad(rate), np.deg2rad(angle), velocity, position], 3)


def airframe(parameters: Parameters) -> quadrotor.Airframe:
    return quadrotor.Airframe(
        mass=parameters.mass,
        gravity=parameters.gravity,
        arm=parameters.arm,
        inertia=tuple(parameters.inertia),
        rotor_inertia=parameters.rotor_inertia,
        thrust_coefficient=parameters.thrust_coefficient,
        torque_coefficient=parameters.torque_coefficient,
    )


def motor(parameters: Parameters) -> quadrotor.Motor:
    return quadrotor.Motor(
        parameters.motor_time_constant,
        parameters.motor_slope,
        parameters.motor_offset,
        parameters.least_throttle,
    )


def controller(parameters: Parameters) -> cascaded_pid.Settings:
    hover = quadrotor.hover_speed(airframe(parameters))
    return cascaded_pid.Settings(
        velocity=cascaded_pid.Gains(*parameters.velocity_gains),
        roll=cascaded_pid.Gains(*parameters.roll_gains),
        pitch=cascaded_pid.Gains(*parameters.pitch_gains),
        yaw=cascaded_pid.Gains(*parameters.yaw_gains),
        altitude=cascaded_pid.Gains(*parameters.altitude_gains),
        tilt_limit=np.deg2rad(parameters.tilt_command_limit_deg),
        integral_limit=parameters.integral_limit,
        hover_throttle=motor(parameters).hover_throttle(hover),
    )


def reference(parameters: Parameters) -> np.ndarray:
    """X, Y, Z in m and psi in rad at every step, (steps + 1, 4)."""
    at = np.arange(parameters.steps + 1) * parameters.period
    times = parameters.path_slowness * np.array(parameters.path_times)
    points = parameters.path_scale * np.array(parameters.path_points)
    flown = path.reference(times, points, at)
    return np.concatenate([flown, np.zeros((len(flown), 1))], axis=1)


def _start(parameters: Parameters) -> np.ndarray:
    """At rest on the first point of the path."""
    state = np.zeros(len(STATE))
    state[POSITION] = reference(parameters)[0, :3]
    return state


def _wrapped(received: np.ndarray, expected: np.ndarray) -> np.ndarray:
    """Received minus expected, the angles' differences taken to [-pi, pi)."""
    difference = received - expected
    angles = difference[..., ANGLES]
    angles -= 2 * np.pi * np.floor((angles + np.pi) / (2 * np.pi))
    return difference


def flying(runs) -> np.ndarray:
    """Which steps were flown, (flights, steps)."""
    return np.arange(runs.error.shape[1]) < runs.recorded["end"][:, None]


def over_flight(runs, per_step: np.ndarray) -> np.ndarray:
    """Mean of (flights, steps) over the steps that were flown, (flights,)."""
    flown = flying(runs)
    return np.where(flown, per_step, 0.0).sum(axis=1) / flown.sum(axis=1)


def squared_distance(runs) -> np.ndarray:
    """Mean squared distance to the reference over each flight, (flights,), in m^2."""
    return over_flight(runs, runs.recorded["distance"] ** 2)


def over(runs: Runs) -> np.ndarray:
    """Which flights tumbled, or left, before the end, (flights,)."""
    return runs.recorded["end"] < runs.error.shape[1]


def share(runs, of: float) -> np.ndarray:
    """Share of the steps with gamma = `of` that the filter takes for what they are, (flights,)."""
    meant = flying(runs) & (runs.recorded["gamma"] == of)
    right = (runs.recorded["arrived"] > 0.5) == bool(of)
    return (meant & right).sum(axis=1) / np.maximum(meant.sum(axis=1), 1)


def squared_error(runs, of: slice) -> np.ndarray:
    """Squared error of a kind of components, mean over each flight, (flights,)."""
    return over_flight(runs, (runs.error[..., of] ** 2).sum(axis=-1))


def altitude(runs) -> np.ndarray:
    """Mean over each flight, (flights,), in m."""
    return over_flight(runs, runs.recorded["position"][..., 2])


class Quadrotor(ClosedLoop):
    """..."""

    Parameters = Parameters
    systems_per_block = 1200  # systems, flights times particles
    keeps_inferred_arrivals = True
    keeps_claimed_variance = False  # none of the tables has it
    trajectory = (("x", "y"), ("x", "z"))

    def topics(self, parameters: Parameters) -> dict[str, tuple[str, ...]]:
        """Of the disturbances: what is flown under them depends on the filter."""
        return {
            "/process": tuple(f"w_{name}" for name in STATE),
            "/sensor": tuple(f"v_{name}" for name in STATE),
            "/network": ("gamma",),
        }

    def period(self, parameters: Parameters) -> float:
        return parameters.period

    def first_step(self, parameters: Parameters) -> int:
        return 0  # y(0) is used: Algorithms 1-3

    def simulate(self, parameters: Parameters, streams) -> dict[str, np.ndarray]:
        steps, n = parameters.steps, len(STATE)
        gamma = losses.arrivals(streams("network").uniform(steps + 1), losses.losses(parameters))
        process = _per_component(parameters.process_deviations)
        noise = _per_component(parameters.measurement_deviations)
        return {
            "/process": process * streams("process").standard_normal(steps, n),
            "/sensor": noise * streams("sensor").standard_normal(steps + 1, n),
            "/network": gamma[:, :, None],
        }

    def model(self, parameters: Parameters) -> Model:
        frame, step = airframe(parameters), parameters.period
        measured = [{i: 1.0} for i in range(len(STATE))]
        process = _per_component(parameters.process_deviations)
        process[POSITION] = parameters.believed_position_deviation
        return Model(
            transition=None,
            transition_jacobian=None,
            measurement=lambda x, sensor: x,
            measurement_jacobian=lambda x, sensor: measured,
            process_covariance=np.diag(process**2),
            measurement_covariance=np.diag(_per_component(parameters.measurement_deviations) ** 2),
            initial_mean=_start(parameters),
            initial_covariance=np.diag(_per_component(parameters.initial_deviations) ** 2),
            network=losses.losses(parameters),
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

    def flight(self, log: Log, estimate: np.ndarray, runs) -> Log:
        """The log of what was flown."""
        path_ = np.broadcast_to(reference(log.parameters), (len(estimate), *estimate.shape[1:2], 4))
        return log._replace(
            fields={
                "/truth": STATE,
                "/received": STATE,
                "/estimate": STATE,
                "/reference": ("x", "y", "z", "psi"),
                "/throttle": tuple(f"motor_{i}" for i in range(1, 5)),
            },
            values=runs.flown | {"/estimate": estimate, "/reference": path_},
        )

    def lost(self, runs: Runs, analysis) -> np.ndarray:
        return over(runs)

    def rows(self, shards: Shards, analysis) -> Rows:
        yield "rmse", "tracking", metrics.root_mean(shards.each(squared_distance))
        for component, of in (("position", POSITION), ("velocity", VELOCITY), ("angles", ANGLES)):
            squared = shards.each(lambda runs, of=of: squared_error(runs, of))
            yield "rmse", component, metrics.root_mean(squared)
        yield "tumbled", "flight", metrics.mean(shards.each(over).astype(float))
        end_time = shards.each(lambda runs: runs.recorded["end_time"])
        yield "end_time", "flight", metrics.mean(end_time)
        if "arrived" in shards.first.recorded:
            for component, of in (("losses", 0), ("arrivals", 1)):
                detected = shards.each(lambda runs, of=of: share(runs, of))
                yield "detected", component, metrics.mean(detected)
        yield "altitude", "Z", metrics.mean(shards.each(altitude))

    def curves(self, shards: Shards) -> Rows:
        distance = shards.each(lambda runs: runs.recorded["distance"])
        yield "distance", "tracking", metrics.mean(distance)


STUDY = Quadrotor()
