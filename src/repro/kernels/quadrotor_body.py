"""The rigid body of a quadrotor in "+" configuration and its motors: repro.models.quadrotor.

A state (12,) is p, q, r, phi, theta, psi, u, v, w, x, y, z. `frame` holds the constants of
`repro.models.quadrotor.constants`; the loads are what the rotors do to the body, over the inertia
that they act on: torques about the three axes, lift, and the spin of the rotors over Jx and Jy.
"""

from repro.kernels.compiled import kernel, scalar
from repro.kernels.elementary import sine_cosine

CORE = 9  # components that drive others; the position drives none
P, Q, R, PHI, THETA, PSI, U, V, W = range(CORE)


@scalar
def loads(frame, speeds):
    """Roll, pitch, yaw, lift, spin over Jx, spin over Jy of rotor speeds (4,)."""
    roll, pitch, yaw, lift, spin_x, spin_y = frame[:6]
    first, second, third, fourth = speeds[0], speeds[1], speeds[2], speeds[3]
    spin = second + fourth - first - third
    first, second, third, fourth = first * first, second * second, third * third, fourth * fourth
    return (
        roll * (second - fourth),
        pitch * (third - first),
        yaw * (second + fourth - first - third),
        lift * (first + second + third + fourth),
        spin_x * spin,
        spin_y * spin,
    )


@kernel
def derivative(frame, x, load, out):
    """dx/dt, (12,)."""
    about_x, about_y, about_z, gravity = frame[6:]
    roll, pitch, yaw, lift, spin_x, spin_y = load
    p, q, r, u, v, w = x[0], x[1], x[2], x[6], x[7], x[8]
    sin_phi, cos_phi = sine_cosine(x[3])
    sin_theta, cos_theta = sine_cosine(x[4])
    sin_psi, cos_psi = sine_cosine(x[5])
    out[0] = roll + q * (spin_x - about_x * r)
    out[1] = pitch - p * (spin_y + about_y * r)
    out[2] = yaw - about_z * p * q
    out[5] = (sin_phi * q + cos_phi * r) / cos_theta
    out[3] = p + sin_theta * out[5]
    out[4] = cos_phi * q - sin_phi * r
    out[6] = gravity * sin_theta + r * v - q * w
    tilted = gravity * cos_theta
    out[7] = p * w - r * u - tilted * sin_phi
    out[8] = lift - tilted * cos_phi + q * u - p * v
    # Rz(psi) Ry(theta) Rx(phi) [u v w]'
    right, up = cos_phi * v - sin_phi * w, sin_phi * v + cos_phi * w
    ahead = cos_theta * u + sin_theta * up
    out[9] = cos_psi * ahead - sin_psi * right
    out[10] = sin_psi * ahead + cos_psi * right
    climb = cos_theta * up - sin_theta * u
    out[11] = 0.0 if x[11] <= 0.0 and climb <= 0.0 else climb  # the ground


@kernel
def jacobian(frame, x, load, out):
    """d(dx/dt)/dx by the components that drive others: the entries that are not zero, (12, CORE).

    tests/oracle/quadrotor_equations.py derives every entry from the laws of motion and prints it.
    """
    about_x, about_y, about_z, gravity = frame[6:]
    spin_x, spin_y = load[4], load[5]
    p, q, r, u, v, w = x[0], x[1], x[2], x[6], x[7], x[8]
    sin_phi, cos_phi = sine_cosine(x[3])
    sin_theta, cos_theta = sine_cosine(x[4])
    sin_psi, cos_psi = sine_cosine(x[5])
    # Body rates: torques, the rotors' spin and the gyroscopic terms.
    dp, dq, dr = out[0], out[1], out[2]
    dp[Q], dp[R] = spin_x - about_x * r, -about_x * q
    dq[P], dq[R] = -spin_y - about_y * r, -about_y * p
    dr[P], dr[Q] = -about_z * q, -about_z * p
    # Euler angles; dphi = p + sin(theta) dpsi, so that its row is that of dpsi times sin(theta).
    dphi, dtheta, dpsi = out[3], out[4], out[5]
    dpsi[Q], dpsi[R] = sin_phi / cos_theta, cos_phi / cos_theta
    dpsi[PHI] = (cos_phi * q - sin_phi * r) / cos_theta
    turning = dpsi[Q] * q + dpsi[R] * r  # dpsi itself
    dpsi[THETA] = turning * (sin_theta / cos_theta)
    dphi[P], dphi[Q], dphi[R] = 1.0, sin_theta * dpsi[Q], sin_theta * dpsi[R]
    dphi[PHI], dphi[THETA] = sin_theta * dpsi[PHI], turning / cos_theta
    dtheta[Q], dtheta[R], dtheta[PHI] = cos_phi, -sin_phi, -turning * cos_theta
    # Body velocity: weight, and the turning of the frame.
    du, dv, dw = out[6], out[7], out[8]
    du[Q], du[R], du[V], du[W] = -w, v, r, -q
    du[THETA] = gravity * cos_theta
    dv[P], dv[R], dv[U], dv[W] = w, -u, -r, p
    dv[PHI], dv[THETA] = -gravity * cos_theta * cos_phi, gravity * sin_theta * sin_phi
    dw[P], dw[Q], dw[U], dw[V] = -v, u, q, -p
    dw[PHI], dw[THETA] = gravity * cos_theta * sin_phi, gravity * sin_theta * cos_phi
    # Position: Rz(psi) Ry(theta) Rx(phi) [u v w]', whose columns are d/du, d/dv and d/dw.
    dx, dy, dz = out[9], out[10], out[11]
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
    moves = 0.0 if x[11] <= 0.0 and climb <= 0.0 else 1.0  # the ground
    dz[PHI], dz[THETA] = moves * cos_theta * level, -moves * forward
    dz[U], dz[V], dz[W] = (
        -moves * sin_theta,
        moves * cos_theta * sin_phi,
        moves * cos_theta * cos_phi,
    )


@kernel
def stages(frame, x, load, period, states, slopes, after):
    """The four states and slopes of RK4, (4, 12) each, and the state after the period in s."""
    for i in range(12):
        states[0, i] = x[i]
    derivative(frame, states[0], load, slopes[0])
    for stage in range(1, 4):
        step = period if stage == 3 else 0.5 * period
        for i in range(12):
            states[stage, i] = x[i] + step * slopes[stage - 1, i]
        derivative(frame, states[stage], load, slopes[stage])
    for i in range(12):
        total = 2.0 * (slopes[1, i] + slopes[2, i]) + slopes[0, i] + slopes[3, i]
        after[i] = period / 6.0 * total + x[i]
    after[11] = 0.0 if after[11] < 0.0 else after[11]  # the ground


@kernel
def transitions(frame, x, speeds, period, after, scratch):
    """States (systems, 12) after constant rotor speeds (systems, 4); scratch: of `stages`."""
    states, slopes = scratch
    for system in range(len(x)):
        load = loads(frame, speeds[system])
        stages(frame, x[system], load, period, states, slopes, after[system])


@kernel
def linearised(frame, x, speeds, period, after, jacobians, scratch):
    """The same with the Jacobians, (systems, 12, 12): the chain rule through the stages of RK4.

    scratch: two of `stages`, zeros (12, CORE), and three more of that shape.
    """
    states, slopes, of_stage, last, slope, total = scratch
    for system in range(len(x)):
        load = loads(frame, speeds[system])
        stages(frame, x[system], load, period, states, slopes, after[system])
        for stage in range(4):
            jacobian(frame, states[stage], load, of_stage)
            step = period if stage == 3 else 0.5 * period
            # d(slope)/dx = J (I + h d(last slope)/dx); nothing depends on the position
            for i in range(12):
                for j in range(CORE):
                    slope[i, j] = of_stage[i, j]
                if stage > 0:
                    for m in range(CORE):
                        if of_stage[i, m] != 0.0:
                            for j in range(CORE):
                                slope[i, j] += step * of_stage[i, m] * last[m, j]
                share = 1.0 if stage == 0 or stage == 3 else 2.0
                for j in range(CORE):
                    total[i, j] = share * slope[i, j] + (total[i, j] if stage > 0 else 0.0)
            for i in range(CORE):
                for j in range(CORE):
                    last[i, j] = slope[i, j]
        found = jacobians[system]
        for i in range(12):
            for j in range(12):
                found[i, j] = period / 6.0 * total[i, j] if j < CORE else 0.0
            found[i, i] += 1.0
        if not after[system, 11] > 0.0:  # on the ground the altitude is zero
            for j in range(12):
                found[11, j] = 0.0


@kernel
def derivatives(frame, x, speeds, out, jacobians):
    """dx/dt, (systems, 12), and its Jacobians (systems, 12, CORE), which are zeros before."""
    for system in range(len(x)):
        load = loads(frame, speeds[system])
        derivative(frame, x[system], load, out[system])
        jacobian(frame, x[system], load, jacobians[system])


@kernel
def motors(motor, decay, speeds, throttle, out):
    """Rotor speeds (systems, 4) after constant throttle in %, which is limited to 0 ... 100.

    motor: slope, offset, the least throttle; decay: e^(-period / time constant).
    """
    slope, offset, least = motor
    for system in range(len(speeds)):
        for i in range(speeds.shape[1]):
            limited = limit(throttle[system, i], 0.0, 100.0)
            steady = slope * limited + offset if limited >= least else 0.0
            out[system, i] = steady + decay * (speeds[system, i] - steady)


@scalar
def limit(value, least, greatest):
    """The value, or the bound beyond which it is."""
    value = least if value < least else value
    return greatest if value > greatest else value
