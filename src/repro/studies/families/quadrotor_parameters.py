"""Parameters of the quadrotor in closed loop, and the parts of the loop that they describe."""

from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from repro.control import cascaded_pid, path
from repro.models import quadrotor
from repro.parameters.values import (
    NotNegative,
    PointParameters,
    Positive,
    Probability,
    Triple,
    Values,
)


class Parameters(PointParameters):
    """Values of one point; [26] is Quad-Sim, on which the paper builds."""

    period: Annotated[Positive, Field(description="s, of sampling and control")]
    mass: Annotated[Positive, Field(description="m, kg")]
    gravity: Annotated[Positive, Field(description="g, m/s^2")]
    arm: Annotated[Positive, Field(description="d, from the centre to a rotor, m")]
    inertia: Annotated[tuple[Positive, Positive, Positive], Field(description="Jx, Jy, Jz, kg m^2")]
    rotor_inertia: Annotated[NotNegative, Field(description="Jm, kg m^2")]
    thrust_coefficient: Annotated[Positive, Field(description="ct, N/RPM^2")]
    torque_coefficient: Annotated[Positive, Field(description="cq, N m/RPM^2")]
    motor_time_constant: Annotated[Positive, Field(description="T, s")]
    motor_slope: Annotated[Positive, Field(description="cr, RPM/%")]
    motor_offset: Annotated[float, Field(description="b, RPM")]
    least_throttle: Annotated[
        float, Field(ge=0, le=100, description="throttle in % below which a rotor stops")
    ]
    velocity_gains: Annotated[
        Triple, Field(description="proportional, integral, derivative; rad per m/s")
    ]
    roll_gains: Annotated[Triple, Field(description="% of throttle per rad, rad s, rad/s")]
    pitch_gains: Annotated[Triple, Field(description="% of throttle per rad, rad s, rad/s")]
    yaw_gains: Annotated[Triple, Field(description="% of throttle per rad, rad s, rad/s")]
    altitude_gains: Annotated[Triple, Field(description="% of throttle per m, m s, m/s")]
    tilt_command_limit_deg: Annotated[
        Positive, Field(description="largest commanded roll and pitch, degrees")
    ]
    integral_limit: Annotated[Positive, Field(description="of each integral, rad s or m s")]
    path_times: Annotated[tuple[NotNegative, ...], Field(min_length=2, description="s, ascending")]
    path_points: Annotated[
        tuple[Triple, ...], Field(min_length=2, description="X, Y, Z at those times, m")
    ]
    path_scale: Annotated[Positive, Field(description="factor of the way-points")]
    path_slowness: Annotated[Positive, Field(description="factor of their times")]
    start_speed: Annotated[NotNegative, Field(description="of every rotor, RPM")]
    measurement_deviations: Annotated[
        tuple[Positive, Positive, Positive, Positive],
        Field(description="of rates, angles, velocity, position: deg/s, deg, m/s, m"),
    ]
    process_deviations: Annotated[
        tuple[NotNegative, NotNegative, NotNegative, NotNegative],
        Field(description="a step, of rates, angles, velocity, position: deg/s, deg, m/s, m"),
    ]
    believed_position_deviation: Annotated[
        NotNegative,
        Field(description="process noise of the position that the filters assume, m a step"),
    ]
    initial_deviations: Annotated[
        tuple[NotNegative, NotNegative, NotNegative, NotNegative],
        Field(description="of the filters' start: deg/s, deg, m/s, m"),
    ]
    loss_process: Annotated[
        Literal["Bernoulli"], Field(description="losses do not depend on the last one")
    ]
    loss_probability: Annotated[Probability, Field(description="Pr(gamma(k) = 0)")]
    tumbled_above_deg: Annotated[
        Positive, Field(description="roll or pitch that ends a flight, degrees")
    ]
    left_beyond: Annotated[
        Positive, Field(description="distance from the origin that ends a flight, beyond 4 Z(0); m")
    ]


class Analysis(Values):
    """Thresholds of the claims."""

    tracks_within: Annotated[
        Positive, Field(description="rms distance of a flight on the path, over the true state's")
    ]
    close_within: Annotated[
        Positive, Field(description="rms distance of a close flight, over that without losses")
    ]


def per_component(deviations: tuple[float, float, float, float]) -> np.ndarray:
    """Standard deviations of rates, angles, velocity and position, of each component, (12,), SI."""
    rate, angle, velocity, position = deviations
    return np.repeat([np.deg2rad(rate), np.deg2rad(angle), velocity, position], 3)


def airframe(parameters: Parameters) -> quadrotor.Airframe:
    """Constants of body and rotors."""
    return quadrotor.Airframe(
        mass=parameters.mass,
        gravity=parameters.gravity,
        arm=parameters.arm,
        inertia=parameters.inertia,
        rotor_inertia=parameters.rotor_inertia,
        thrust_coefficient=parameters.thrust_coefficient,
        torque_coefficient=parameters.torque_coefficient,
    )


def motor(parameters: Parameters) -> quadrotor.Motor:
    """Constants of the motors."""
    return quadrotor.Motor(
        parameters.motor_time_constant,
        parameters.motor_slope,
        parameters.motor_offset,
        parameters.least_throttle,
    )


def controller(parameters: Parameters) -> cascaded_pid.Settings:
    """Gains and limits in rad, with the throttle that hovers."""
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
