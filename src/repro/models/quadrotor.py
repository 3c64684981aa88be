"""Rigid body of a quadrotor in "+" configuration, sampled by RK4, and its motors.

After Quad-Sim [unknown_losses ref. 26]. State (p, q, r, phi, theta, psi, u, v, w, x, y, z): the
paper's symbols in lower case, as ROS wants field names;
body rates in rad/s, roll, pitch and yaw in rad, body velocity in m/s, position in m, z up. Rotor
speeds w1 ... w4 in RPM; motor 1 is on +x and motor 2 on +y. States are (..., 12) and rotor
speeds (..., 4); memory is component-major inside.
"""

from typing import NamedTuple

import numpy as np

STATE = ("p", "q", "r", "phi", "theta", "psi", "u", "v", "w", "x", "y", "z")
RATES, ANGLES, VELOCITY, POSITION = (slice(i, i + 3) for i in (0, 3, 6, 9))
CORE = 9  # components that drive others; the position drives none
P, Q, R, PHI, THETA, PSI, U, V, W = range(CORE)
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


class Motor(NamedTuple):
    """First-order lag from throttle in % to rotor speed in RPM."""

    time_constant: float  # T, s
    slope: float  # cr, RPM/%
    offset: float  # b, RPM
    least_throttle: float  # %, below which the rotor stops

    def hover_throttle(self, speed: float) -> float:
        """Throttle in % that holds a rotor speed in RPM."""
        return (speed - self.offset) / self.slope


def hover_speed(frame: Airframe) -> float:
    """Rotor speed in RPM whose thrust carries the weight."""
    return float(np.sqrt(frame.mass * frame.gravity / (4 * frame.thrust_coefficient)))


def motor_step(motor: Motor, speeds: np.ndarray, throttle: np.ndarray, period: float) -> np.ndarray:
    """Rotor speeds after `period` s of constant throttle, exactly; any shape."""
    throttle = np.clip(throttle, 0.0, 100.0)
    running = throttle >= motor.least_throttle
    steady = np.where(running, motor.slope * throttle + motor.offset, 0.0)
    return steady + np.exp(-period / motor.time_constant) * (speeds - steady)


class _Loads(NamedTuple):
    """Torques, lift and spin of the rotors over the inertia that they act on; (batch) each."""

    roll: np.ndarray
    pitch: np.ndarray
    yaw: np.ndarray
    lift: np.ndarray
    spin_x: np.ndarray  # G / Jx: the rotors' own angular momentum
    spin_y: np.ndarray  # G / Jy


def _loads(frame: Airframe, speeds: np.ndarray) -> _Loads:
    w = speeds.T
    jx, jy, jz = frame.inertia
    squared = w * w
    arm, drag = frame.arm * frame.thrust_coefficient, frame.torque_coefficient
    spin = frame.rotor_inertia * RPM * (w[1] + w[3] - w[0] - w[2])
    return _Loads(
        roll=arm / jx * (squared[1] - squared[3]),
        pitch=arm / jy * (squared[2] - squared[0]),
        yaw=drag / jz * (squared[1] + squared[3] - squared[0] - squared[2]),
        lift=frame.thrust_coefficient / frame.mass * squared.sum(axis=0),
        spin_x=spin / jx,
        spin_y=spin / jy,
    )


def _gyroscopic(frame: Airframe) -> tuple[float, float, float]:
    jx, jy, jz = frame.inertia
    return (jz - jy) / jx, (jx - jz) / jy, (jy - jx) / jz


def _derivative(frame: Airframe, x: np.ndarray, loads: _Loads) -> np.ndarray:
    """dx/dt of states (12, batch)."""
    p, q, r, _, _, _, u, v, w, _, _, z = x
    (sin_phi, sin_theta, sin_psi), (cos_phi, cos_theta, cos_psi) = np.sin(x[3:6]), np.cos(x[3:6])
    about_x, about_y, about_z = _gyroscopic(frame)
    g = frame.gravity
    out = np.empty_like(x)
    out[0] = loads.roll + q * (loads.spin_x - about_x * r)
    out[1] = loads.pitch - p * (loads.spin_y + about_y * r)
    out[2] = loads.yaw - about_z * p * q
    turning = sin_phi * q + cos_phi * r
    out[5] = turning / cos_theta
    out[3] = p + sin_theta * out[5]
    out[4] = cos_phi * q - sin_phi * r
    out[6] = g * sin_theta + r * v - q * w
    tilted = g * cos_theta
    out[7] = p * w - r * u - tilted * sin_phi
    out[8] = loads.lift - tilted * cos_phi + q * u - p * v
    # Rz(psi) Ry(theta) Rx(phi) [U V W]'
    right, up = cos_phi * v - sin_phi * w, sin_phi * v + cos_phi * w
    ahead = cos_theta * u + sin_theta * up
    out[9] = cos_psi * ahead - sin_psi * right
    out[10] = sin_psi * ahead + cos_psi * right
    climb = cos_theta * up - sin_theta * u
    out[11] = np.where((z <= 0) & (climb <= 0), 0.0, climb)  # the ground
    return out


def derivative(frame: Airframe, x: np.ndarray, speeds: np.ndarray) -> np.ndarray:
    """dx/dt, (..., 12)."""
    return _derivative(frame, x.T, _loads(frame, speeds)).T


def _stages(frame: Airframe, x: np.ndarray, loads: _Loads, period: float):
    """States and slopes of the four stages of RK4, (12, 4, batch), and the state after the step."""
    states, slopes = np.empty((2, 12, 4, *x.shape[1:]))
    states[:, 0] = x
    slopes[:, 0] = _derivative(frame, x, loads)
    for i, step in enumerate((period / 2, period / 2, period)):
        states[:, i + 1] = x + step * slopes[:, i]
        slopes[:, i + 1] = _derivative(frame, states[:, i + 1], loads)
    after = slopes[:, 1] + slopes[:, 2]
    after *= 2
    after += slopes[:, 0]
    after += slopes[:, 3]
    after *= period / 6
    after += x
    after[11] = np.maximum(after[11], 0.0)  # the ground
    return states, after


def transition(frame: Airframe, x: np.ndarray, speeds: np.ndarray, period: float) -> np.ndarray:
    """State after `period` s of constant rotor speeds, by one step of RK4, (..., 12)."""
    return _stages(frame, x.T, _loads(frame, speeds), period)[1].T


def linearised(
    frame: Airframe, x: np.ndarray, speeds: np.ndarray, period: float
) -> tuple[np.ndarray, np.ndarray]:
    """The transition and its Jacobian, (..., 12, 12): the chain rule through the stages of RK4."""
    loads = _loads(frame, speeds)
    states, after = _stages(frame, x.T, loads, period)
    of_stage = _stage_jacobian(frame, states, loads)
    slope = total = of_stage[0]
    for i, step in enumerate((period / 2, period / 2, period)):
        # d(slope i)/dx = J_i (I + h d(slope i-1)/dx); nothing depends on the position
        slope = of_stage[i + 1] + step * (of_stage[i + 1] @ slope[..., :CORE, :])
        total = total + (2 * slope if i < 2 else slope)
    jacobian = np.zeros((*x.shape, 12))
    jacobian[..., :CORE] = period / 6 * total
    jacobian[..., range(12), range(12)] += 1.0
    jacobian[..., 11, :] *= (after[11] > 0)[..., None]  # on the ground the altitude is zero
    return after.T, jacobian


def derivative_jacobian(frame: Airframe, x: np.ndarray, speeds: np.ndarray) -> np.ndarray:
    """d(dx/dt)/dx by the components that drive others, (..., 12, CORE)."""
    return _stage_jacobian(frame, x.T, _loads(frame, speeds))


def _stage_jacobian(frame: Airframe, x: np.ndarray, loads: _Loads) -> np.ndarray:
    """The same of states (12, ...).

    tests/oracle/quadrotor_equations.py derives every entry from the laws of motion and prints it.
    """
    p, q, r, _, _, _, u, v, w, _, _, z = x
    (sin_phi, sin_theta, sin_psi), (cos_phi, cos_theta, cos_psi) = np.sin(x[3:6]), np.cos(x[3:6])
    about_x, about_y, about_z = _gyroscopic(frame)
    g = frame.gravity
    entries = np.zeros((12, CORE, *x.shape[1:]))
    # Body rates: torques, the rotors' spin and the gyroscopic terms.
    dp, dq, dr = entries[:3]
    dp[Q], dp[R] = loads.spin_x - about_x * r, -about_x * q
    dq[P], dq[R] = -loads.spin_y - about_y * r, -about_y * p
    dr[P], dr[Q] = -about_z * q, -about_z * p
    # Euler angles; dphi = p + sin(theta) dpsi, so that its row is that of dpsi times sin(theta).
    dphi, dtheta, dpsi = entries[3:6]
    dpsi[Q], dpsi[R] = sin_phi / cos_theta, cos_phi / cos_theta
    dpsi[PHI] = (cos_phi * q - sin_phi * r) / cos_theta
    turning = dpsi[Q] * q + dpsi[R] * r  # dpsi itself
    dpsi[THETA] = turning * (sin_theta / cos_theta)
    dphi[P], dphi[Q], dphi[R] = 1.0, sin_theta * dpsi[Q], sin_theta * dpsi[R]
    dphi[PHI], dphi[THETA] = sin_theta * dpsi[PHI], turning / cos_theta
    dtheta[Q], dtheta[R], dtheta[PHI] = cos_phi, -sin_phi, -turning * cos_theta
    # Body velocity: weight, and the turning of the frame.
    du, dv, dw = entries[6:9]
    tilted = cos_theta * sin_phi, cos_theta * cos_phi
    du[Q], du[R], du[V], du[W] = -w, v, r, -q
    du[THETA] = g * cos_theta
    dv[P], dv[R], dv[U], dv[W] = w, -u, -r, p
    dv[PHI], dv[THETA] = -g * tilted[1], g * sin_theta * sin_phi
    dw[P], dw[Q], dw[U], dw[V] = -v, u, q, -p
    dw[PHI], dw[THETA] = g * tilted[0], g * sin_theta * cos_phi
    # Position: Rz(psi) Ry(theta) Rx(phi) [u v w]', whose columns are d/du, d/dv and d/dw.
    dx, dy, dz = entries[9:12]
    level, lifted = cos_phi * v - sin_phi * w, sin_phi * v + cos_phi * w
    forward = cos_theta * u + sin_theta * lifted
    climb = cos_theta * lifted - sin_theta * u  # dz itself
    banked = sin_theta * level
    dx[PHI], dy[PHI] = cos_psi * banked + sin_psi * lifted, sin_psi * banked - cos_psi * lifted
    dx[THETA], dy[THETA] = cos_psi * climb, sin_psi * climb
    dx[PSI], dy[PSI] = -sin_psi * forward - cos_psi * level, cos_psi * forward - sin_psi * level
    dx[U], dy[U] = cos_psi * cos_theta, sin_psi * cos_theta
    sideways, upward = sin_theta * sin_phi, sin_theta * cos_phi
    dx[V], dy[V] = cos_psi * sideways - sin_psi * cos_phi, sin_psi * sideways + cos_psi * cos_phi
    dx[W], dy[W] = cos_psi * upward + sin_psi * sin_phi, sin_psi * upward - cos_psi * sin_phi
    dz[PHI], dz[THETA], dz[U], dz[V], dz[W] = cos_theta * level, -forward, -sin_theta, *tilted
    if (z <= 0).any():
        dz *= ~((z <= 0) & (climb <= 0))  # the ground
    return np.ascontiguousarray(np.moveaxis(entries, (0, 1), (-2, -1)))
