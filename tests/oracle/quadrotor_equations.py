"""The quadrotor's equations derived from Newton's and Euler's laws by sympy, and their Jacobian.

    python -m tests.oracle.quadrotor_equations

prints every entry of the Jacobian that is not zero, as those in repro.models.quadrotor are.
"""

from functools import cache

import sympy as sp

STATE = sp.symbols("p q r phi theta psi u v w x y z", real=True)
LOADS = sp.symbols("roll pitch yaw lift spin_x spin_y", real=True)  # as in the model's _Loads
INERTIA = sp.symbols("Jx Jy Jz", positive=True)
GRAVITY = sp.Symbol("g", positive=True)


def rotation() -> sp.Matrix:
    """From the body to the inertial frame: Rz(psi) Ry(theta) Rx(phi)."""
    phi, theta, psi = STATE[3:6]
    about_x = sp.Matrix([[1, 0, 0], [0, sp.cos(phi), -sp.sin(phi)], [0, sp.sin(phi), sp.cos(phi)]])
    about_y = sp.Matrix(
        [[sp.cos(theta), 0, sp.sin(theta)], [0, 1, 0], [-sp.sin(theta), 0, sp.cos(theta)]]
    )
    about_z = sp.Matrix([[sp.cos(psi), -sp.sin(psi), 0], [sp.sin(psi), sp.cos(psi), 0], [0, 0, 1]])
    return about_z * about_y * about_x


@cache
def derivative() -> sp.Matrix:
    """dx/dt above the ground, (12, 1)."""
    rates, angles, velocity = (sp.Matrix(STATE[i : i + 3]) for i in (0, 3, 6))
    roll, pitch, yaw, lift, spin_x, spin_y = LOADS
    turn = rotation()
    # Euler: J domega/dt = torque - omega x (J omega + h), h the momentum of the rotors. The loads
    # are divided by the inertias. The spin is counted along rotors 2 and 4, which turn to -z: -h_z.
    inertia = sp.diag(*INERTIA)
    of_rotors = sp.Matrix([spin_x * rates[1], -spin_y * rates[0], 0])
    turning = sp.Matrix([roll, pitch, yaw]) + of_rotors
    turning -= inertia.inv() * rates.cross(inertia * rates)
    # Rates of the Euler angles: R' dR/dt is the cross-product matrix of the body rates.
    dots = sp.Matrix(sp.symbols("dphi dtheta dpsi"))
    change = sum((turn.diff(a) * d for a, d in zip(angles, dots, strict=True)), sp.zeros(3, 3))
    skew = (turn.T * change).applyfunc(sp.simplify)
    solved = sp.solve(sp.Matrix([skew[2, 1], skew[0, 2], skew[1, 0]]) - rates, list(dots))
    # Newton in the turning frame: weight and lift, less omega x velocity.
    weight = turn.T * sp.Matrix([0, 0, -GRAVITY])
    accelerated = weight + sp.Matrix([0, 0, lift]) - rates.cross(velocity)
    tumbling = sp.Matrix([solved[dot] for dot in dots])
    return sp.Matrix.vstack(turning, tumbling, accelerated, turn * velocity)


def jacobian() -> sp.Matrix:
    """d(dx/dt)/dx, (12, 12)."""
    return derivative().jacobian(sp.Matrix(STATE))


def main() -> None:
    entries = jacobian().applyfunc(sp.trigsimp)
    for i, of in enumerate(STATE):
        for j, by in enumerate(STATE):
            if entries[i, j] != 0:
                print(f"d(d{of}/dt)/d{by} = {entries[i, j]}")


if __name__ == "__main__":
    main()
