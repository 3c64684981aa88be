"""The target and the sensors of [packet_delays (40)-(42), Algorithm 1].

States of the coordinated turn are (5, states): px, py, vx, vy, omega.
"""

import numpy as np

from repro.kernels.compiled import kernel, scalar
from repro.kernels.elementary import HALF_PI, TRIGONOMETRIC_RANGE, sine_cosine

SERIES_BELOW = 1e-3  # |omega T| below which the 0/0 quotients are taken from their series


@scalar
def quotients(omega, time):
    """sin(a)/omega and (1 - cos(a))/omega, a = omega T, and the sine and cosine of a."""
    angle = omega * time
    if abs(angle) > TRIGONOMETRIC_RANGE:  # of an estimate that is lost; a remainder is exact
        angle = angle % (4.0 * HALF_PI)
    sine, cosine = sine_cosine(angle)
    near = abs(angle) < SERIES_BELOW
    safe = 1.0 if near else omega
    square = angle * angle
    along = time * (1.0 - square * (1 / 6)) if near else sine / safe
    across = time * angle * 0.5 * (1.0 - square * (1 / 12)) if near else (1.0 - cosine) / safe
    return along, across, sine, cosine


@kernel
def transition(x, time, out):
    """f(x) of (40) over the time T in s."""
    for i in range(x.shape[1]):
        vx, vy = x[2, i], x[3, i]
        along, across, sine, cosine = quotients(x[4, i], time)
        out[0, i] = x[0, i] + along * vx - across * vy
        out[1, i] = x[1, i] + across * vx + along * vy
        out[2, i] = cosine * vx - sine * vy
        out[3, i] = sine * vx + cosine * vy
        out[4, i] = x[4, i]


@kernel
def jacobian(x, time, out):
    """f'(x): the entries (0, 2), (0, 3), (2, 2), (3, 2) and (0, 4) ... (3, 4), out (8, states)."""
    for i in range(x.shape[1]):
        vx, vy, omega = x[2, i], x[3, i], x[4, i]
        along, across, sine, cosine = quotients(omega, time)
        angle = omega * time
        near = abs(angle) < SERIES_BELOW
        safe = 1.0 if near else omega
        # Derivatives of the quotients by omega; T cos(a) - along cancels to a small difference.
        d_along = -(time * time) * angle * (1 / 3) if near else (time * cosine - along) / safe
        d_across = (
            0.5 * time * time * (1.0 - 0.25 * angle * angle)
            if near
            else (time * sine - across) / safe
        )
        out[0, i], out[1, i], out[2, i], out[3, i] = along, -across, cosine, sine
        out[4, i] = d_along * vx - d_across * vy
        out[5, i] = d_across * vx + d_along * vy
        out[6, i] = -time * (sine * vx + cosine * vy)
        out[7, i] = time * (cosine * vx - sine * vy)


@kernel
def ranges(positions, sensors, noise, out):
    """Noise of a step (trials, steps), then the range to every sensor with it, as a log has them.

    positions (trials, steps, 2) of the target, sensors (trials, sensors, 2), out (trials, steps,
    sensors + 1).
    """
    for trial in range(len(noise)):
        for k in range(noise.shape[1]):
            x, y, v = positions[trial, k, 0], positions[trial, k, 1], noise[trial, k]
            out[trial, k, 0] = v
            for sensor in range(sensors.shape[1]):
                dx, dy = x - sensors[trial, sensor, 0], y - sensors[trial, sensor, 1]
                out[trial, k, sensor + 1] = np.sqrt(dx * dx + dy * dy) + v


@kernel
def nearest(positions, targets, tasked):
    """The sensor nearest to each target (trials, 2); positions (trials, sensors, 2)."""
    for trial in range(len(positions)):
        x, y = targets[trial, 0], targets[trial, 1]
        least, found = -1.0, 0
        for sensor in range(positions.shape[1]):
            dx, dy = positions[trial, sensor, 0] - x, positions[trial, sensor, 1] - y
            squared = dx * dx + dy * dy
            if squared < least or least < 0.0:
                least, found = squared, sensor
        tasked[trial] = found
