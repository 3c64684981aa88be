"""Cascaded PID controller of a quadrotor and the mixing of its commands.

After Quad-Sim [unknown_losses ref. 26]. The position error is the velocity command; velocity errors
command roll and pitch; those, yaw and altitude command the throttles. All feedback is the estimate.
Arrays are component-major.
"""

from typing import NamedTuple

import numpy as np


class Gains(NamedTuple):
    """Gains of a loop on error, integral and derivative; commands in % of throttle or in rad."""

    proportional: float
    integral: float
    derivative: float


class Settings(NamedTuple):
    """Gains and limits of all loops."""

    velocity: Gains  # from velocity error in m/s to tilt in rad
    roll: Gains  # from angle errors in rad, derivative on the body rate in rad/s
    pitch: Gains
    yaw: Gains
    altitude: Gains  # from altitude error in m, derivative on the climb in m/s
    tilt_limit: float  # of the commanded roll and pitch, rad
    integral_limit: float  # of each integral
    hover_throttle: float  # %


class State(NamedTuple):
    """Memory of the controller, component-major."""

    integrals: np.ndarray  # of the errors of roll, pitch, yaw, altitude, (4, flights)
    last: np.ndarray  # U, V, Z of the last estimate, (3, flights)


class Command(NamedTuple):
    """Commands of one step, (flights,) each: tilts in rad, loops in % of throttle."""

    tilt_roll: np.ndarray
    tilt_pitch: np.ndarray
    roll: np.ndarray
    pitch: np.ndarray
    yaw: np.ndarray
    altitude: np.ndarray


def start(estimate: np.ndarray) -> State:
    """Before the first estimate (12, flights): no integral, and no derivative at the first step."""
    return State(np.zeros((4, *estimate.shape[1:])), estimate[[6, 7, 11]])


def control(
    settings: Settings, state: State, estimate: np.ndarray, reference: np.ndarray, period: float
) -> tuple[Command, State]:
    """Commands from the estimate (12, flights) and the reference X, Y, Z, psi; the next state."""
    p, q, r, phi, theta, psi, u, v, _, x, y, z = estimate
    to_x, to_y, to_z, to_psi = reference
    current = np.stack([u, v, z])
    du, dv, dz = (current - state.last) / period  # backward differences
    # Outer loop: the position error in the heading frame is the velocity command.
    east, north = to_x - x, to_y - y
    sine, cosine = np.sin(psi), np.cos(psi)
    outer, limit = settings.velocity, settings.tilt_limit
    ahead, left = cosine * east + sine * north - u, cosine * north - sine * east - v
    tilt_pitch = np.clip(outer.proportional * ahead - outer.derivative * du, -limit, limit)
    tilt_roll = np.clip(outer.derivative * dv - outer.proportional * left, -limit, limit)
    # Inner loops.
    errors = np.stack([tilt_roll - phi, tilt_pitch - theta, to_psi - psi, to_z - z])
    loops = (settings.roll, settings.pitch, settings.yaw, settings.altitude)
    commands = [
        gains.proportional * error + gains.integral * integral - gains.derivative * rate
        for gains, error, integral, rate in zip(
            loops, errors, state.integrals, (p, q, r, dz), strict=True
        )
    ]
    commands[3] += settings.hover_throttle
    bound = settings.integral_limit
    integrals = np.clip(state.integrals + period * errors, -bound, bound)
    return Command(tilt_roll, tilt_pitch, *commands), State(integrals, current)


def mixed(command: Command, configuration: str = "+") -> np.ndarray:
    """Throttles of the motors in %, (4, flights), not yet limited; configuration "+" or "X"."""
    roll, pitch, yaw, lift = command.roll, command.pitch, command.yaw, command.altitude
    if configuration == "+":
        turn = (-pitch, roll, pitch, -roll)
    else:
        turn = (-pitch - roll, roll - pitch, pitch + roll, pitch - roll)
    counter, along = lift - yaw, lift + yaw  # motors 1 and 3 turn against 2 and 4
    return np.stack([counter + turn[0], along + turn[1], counter + turn[2], along + turn[3]])
