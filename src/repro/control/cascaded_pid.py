"""Settings of the cascaded PID controller of a quadrotor.

After Quad-Sim [unknown_losses ref. 26]. The position error is the velocity command; velocity errors
command roll and pitch; those, yaw and altitude command the throttles. All feedback is the estimate.
repro.kernels.quadrotor_flight has the loops and the mixing of their commands.
"""

from typing import Any, NamedTuple

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

    def gains(self) -> np.ndarray:
        """As the kernels have them, a row for each loop, (5, 3)."""
        return np.array([self.velocity, self.roll, self.pitch, self.yaw, self.altitude])

    def limits(self) -> tuple[float, float, float]:
        """Of the tilts and of the integrals, and the throttle that hovers."""
        return self.tilt_limit, self.integral_limit, self.hover_throttle


class Memory(NamedTuple):
    """What the controller keeps of each flight."""

    integrals: Any  # of the errors of roll, pitch, yaw, altitude, (flights, 4)
    last: Any  # U, V, Z of the last estimate, (flights, 3)


def start(estimate: np.ndarray) -> Memory:
    """Before the first estimate (flights, 12): no integral, and no derivative at the first step."""
    return Memory(np.zeros((len(estimate), 4)), np.array(estimate[:, [6, 7, 11]], order="C"))
