"""Rigid body of a quadrotor in "+" configuration, sampled by RK4, and its motors.

After Quad-Sim [unknown_losses ref. 26]. State (p, q, r, phi, theta, psi, u, v, w, x, y, z): the
paper's symbols in lower case, as ROS wants field names;
body rates in rad/s, roll, pitch and yaw in rad, body velocity in m/s, position in m, z up. Rotor
speeds w1 ... w4 in RPM; motor 1 is on +x and motor 2 on +y. States are (..., 12) and rotor
speeds (..., 4); repro.kernels.quadrotor_body has the equations.
"""

from typing import Any, NamedTuple

import numpy as np

from repro.kernels import arrays
from repro.kernels import quadrotor_body as kernels
from repro.kernels.quadrotor_body import CORE

STATE = ("p", "q", "r", "phi", "theta", "psi", "u", "v", "w", "x", "y", "z")
RATES, ANGLES, VELOCITY, POSITION = (slice(i, i + 3) for i in (0, 3, 6, 9))
RPM = 2 * np.pi / 60  # rad/s


class Airframe(NamedTuple):
    """Constants of body and rotors, SI but for RPM."""

    mass: float  # m, kg
    gravity: float  # g, m/s^2
    arm: float  # d, m
    inertia: tuple[float, float, float]  # Jx, Jy, Jz, kg m^2
    rotor_inertia: float  # Jm, kg m^2
    thrust_coefficient: float  # ct, N/RPM^2
    torque_coefficient: float  # cq, N m/RPM^2

    def constants(self) -> tuple[float, ...]:
        """Those of the loads, of the gyroscopic terms, and gravity, as the kernels have them."""
        jx, jy, jz = self.inertia
        force, momentum = self.arm * self.thrust_coefficient, self.rotor_inertia * RPM
        return (
            force / jx,
            force / jy,
            self.torque_coefficient / jz,
            self.thrust_coefficient / self.mass,
            momentum / jx,  # the rotors' own angular momentum
            momentum / jy,
            (jz - jy) / jx,
            (jx - jz) / jy,
            (jy - jx) / jz,
            self.gravity,
        )


class Motor(NamedTuple):
    """First-order lag from throttle in % to rotor speed in RPM."""

    time_constant: float  # T, s
    slope: float  # cr, RPM/%
    offset: float  # b, RPM
    least_throttle: float  # %, below which the rotor stops

    def constants(self) -> tuple[float, float, float]:
        """As the kernels have them."""
        return self.slope, self.offset, self.least_throttle

    def decay(self, period: float) -> float:
        """Share of a speed's distance to its steady value that is left after `period` s."""
        return arrays.exp(-period / self.time_constant)

    def hover_throttle(self, speed: float) -> float:
        """Throttle in % that holds a rotor speed in RPM."""
        return (speed - self.offset) / self.slope


def hover_speed(frame: Airframe) -> float:
    """Rotor speed in RPM whose thrust carries the weight."""
    return float(np.sqrt(frame.mass * frame.gravity / (4 * frame.thrust_coefficient)))


def motor_step(motor: Motor, speeds: np.ndarray, throttle: np.ndarray, period: float) -> np.ndarray:
    """Rotor speeds after `period` s of constant throttle, exactly; any shape (..., 4)."""
    out = np.empty(np.shape(speeds))
    kernels.motors(
        motor.constants(), motor.decay(period), _flat(speeds), _flat(throttle), _flat(out)
    )
    return out


def derivative(frame: Airframe, x: np.ndarray, speeds: np.ndarray) -> np.ndarray:
    """dx/dt, (..., 12)."""
    return _derivatives(frame, x, speeds)[0]


def derivative_jacobian(frame: Airframe, x: np.ndarray, speeds: np.ndarray) -> np.ndarray:
    """d(dx/dt)/dx by the components that drive others, (..., 12, CORE)."""
    return _derivatives(frame, x, speeds)[1]


def _derivatives(
    frame: Airframe, x: np.ndarray, speeds: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    out, jacobians = np.empty(x.shape), np.zeros((*x.shape, CORE))
    kernels.derivatives(
        frame.constants(), _flat(x), _flat(speeds), _flat(out), jacobians.reshape(-1, 12, CORE)
    )
    return out, jacobians


def transition(frame: Airframe, x: np.ndarray, speeds: np.ndarray, period: float) -> np.ndarray:
    """State after `period` s of constant rotor speeds, by one step of RK4, (..., 12)."""
    after = np.empty(x.shape)
    kernels.transitions(
        frame.constants(), _flat(x), _flat(speeds), period, _flat(after), stages_scratch()
    )
    return after


def linearised(
    frame: Airframe, x: np.ndarray, speeds: np.ndarray, period: float
) -> tuple[np.ndarray, np.ndarray]:
    """The transition and its Jacobian, (..., 12, 12)."""
    after, jacobians = np.empty(x.shape), np.empty((*x.shape, 12))
    scratch = (*stages_scratch(), *np.zeros((4, 12, CORE)))
    kernels.linearised(
        frame.constants(),
        _flat(x),
        _flat(speeds),
        period,
        _flat(after),
        jacobians.reshape(-1, 12, 12),
        scratch,
    )
    return after, jacobians


def stages_scratch() -> tuple[Any, Any]:
    """Room for the stages of RK4."""
    return np.empty((4, 12)), np.empty((4, 12))


def _flat(values: np.ndarray) -> np.ndarray:
    """As the kernels have them: (systems, components); of an array in order, a view of it."""
    return np.ascontiguousarray(values, dtype=float).reshape(-1, np.shape(values)[-1])
