"""A step of a quadrotor that is flown on an estimate: controller, mixing, plant, motors.

repro.control.cascaded_pid has the settings and repro.control.flight the order of a step.
"""

import numpy as np

from repro.kernels.compiled import kernel
from repro.kernels.elementary import sine_cosine
from repro.kernels.quadrotor_body import limit, loads, motors, stages

# Rows of the gains, whose columns are proportional, integral, derivative.
VELOCITY, ROLL, PITCH, YAW, ALTITUDE = range(5)


@kernel
def control(gains, limits, integrals, last, estimate, reference, period, commands):
    """Commands of one flight: tilts of roll and pitch in rad, then roll, pitch, yaw and altitude.

    The last four, in % of throttle, go into commands[2:]. estimate (12,), reference X, Y, Z, psi;
    integrals (4,) of the errors of roll, pitch, yaw and altitude, last (3,) U, V, Z of the last
    estimate: both move on. limits: of the tilts, of each integral, and the throttle that hovers.
    """
    tilt_limit, integral_limit, hover = limits
    phi, theta, psi = estimate[3], estimate[4], estimate[5]
    u, v, z = estimate[6], estimate[7], estimate[11]
    du, dv, dz = (u - last[0]) / period, (v - last[1]) / period, (z - last[2]) / period
    last[0], last[1], last[2] = u, v, z
    # Outer loop: the position error in the heading frame is the velocity command.
    east, north = reference[0] - estimate[9], reference[1] - estimate[10]
    sine, cosine = sine_cosine(psi)
    ahead, left = cosine * east + sine * north - u, cosine * north - sine * east - v
    outer = gains[VELOCITY]
    tilt_roll = limit(outer[2] * dv - outer[0] * left, -tilt_limit, tilt_limit)
    tilt_pitch = limit(outer[0] * ahead - outer[2] * du, -tilt_limit, tilt_limit)
    commands[0], commands[1] = tilt_roll, tilt_pitch
    # Inner loops.
    errors = tilt_roll - phi, tilt_pitch - theta, reference[3] - psi, reference[2] - z
    rates = estimate[0], estimate[1], estimate[2], dz
    for i in range(4):
        inner = gains[ROLL + i]
        commands[2 + i] = inner[0] * errors[i] + inner[1] * integrals[i] - inner[2] * rates[i]
        moved = integrals[i] + period * errors[i]
        integrals[i] = limit(moved, -integral_limit, integral_limit)
    commands[5] += hover


@kernel
def mix(commands, throttle):
    """Throttles (4,) of the motors in %, limited, from roll, pitch, yaw, altitude; "+"."""
    roll, pitch, yaw, lift = commands[2], commands[3], commands[4], commands[5]
    counter, along = lift - yaw, lift + yaw  # motors 1 and 3 turn against 2 and 4
    throttle[0] = limit(counter - pitch, 0.0, 100.0)
    throttle[1] = limit(along + roll, 0.0, 100.0)
    throttle[2] = limit(counter + pitch, 0.0, 100.0)
    throttle[3] = limit(along - roll, 0.0, 100.0)


@kernel
def airworthy(state, tilt_limit, range_limit):
    """Whether a state (12,) is finite, upright and near enough."""
    for i in range(12):
        if not abs(state[i]) < np.inf:
            return False
    away = np.sqrt(state[9] * state[9] + state[10] * state[10] + state[11] * state[11])
    upright = abs(state[3]) <= tilt_limit and abs(state[4]) <= tilt_limit
    return upright and away <= range_limit


@kernel
def fly(
    k,
    system,
    memory,
    estimate,
    reference,
    process,
    truth,
    speeds,
    end,
    next_truth,
    throttle,
    next_speeds,
    scratch,
):
    """All flights from step k to k + 1, (flights, ...) each; end: the first step not flown.

    system: frame, motor, decay of the motors, gains, limits of the controller, period, and tilt
    and distance beyond which a flight ends. memory: integrals and last of `control`.
    """
    frame, motor, decay, gains, limits, period, bounds = system
    integrals, last = memory
    commands, states, slopes = scratch
    for flight in range(len(truth)):
        control(
            gains,
            limits,
            integrals[flight],
            last[flight],
            estimate[flight],
            reference,
            period,
            commands,
        )
        mix(commands, throttle[flight])
        flown = next_truth[flight]
        load = loads(frame, speeds[flight])
        stages(frame, truth[flight], load, period, states, slopes, flown)
        for i in range(12):
            flown[i] += process[flight, i]
        if end[flight] > k and not airworthy(flown, bounds[0], bounds[1]):
            end[flight] = k + 1
        if end[flight] <= k + 1:
            for i in range(12):
                flown[i] = truth[flight, i]
    motors(motor, decay, speeds, throttle, next_speeds)
