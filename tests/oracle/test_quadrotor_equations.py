"""The quadrotor's derivative and Jacobian, entry by entry, against the symbolic derivation."""

import numpy as np
import pytest

from repro.models import quadrotor as model
from repro.studies import quadrotor as study
from tests.conftest import points

sympy = pytest.importorskip("sympy")
equations = pytest.importorskip("tests.oracle.quadrotor_equations")

FRAME = study.airframe(points()["quadrotor"]["nominal"].parameters)


@pytest.fixture(scope="module")
def states():
    """States all over the flight envelope, above the ground, and rotor speeds."""
    random = np.random.default_rng(4)
    x = random.standard_normal((8, 12)) * np.repeat([2.0, 0.5, 3.0, 5.0], 3)
    x[:, 11] += 40
    return x, 4100 + 500 * random.standard_normal((8, 4))


def loads(speeds):
    """What the rotors do to the body, over its inertia: as in the derivation, (flights, 6)."""
    (jx, jy, jz), squared = FRAME.inertia, speeds**2
    arm, drag = FRAME.arm * FRAME.thrust_coefficient, FRAME.torque_coefficient
    spin = FRAME.rotor_inertia * 2 * np.pi / 60 * (speeds @ [-1, 1, -1, 1])
    return np.stack(
        [
            arm * (squared[:, 1] - squared[:, 3]) / jx,
            arm * (squared[:, 2] - squared[:, 0]) / jy,
            drag * (squared @ [-1, 1, -1, 1]) / jz,
            FRAME.thrust_coefficient * squared.sum(axis=1) / FRAME.mass,
            spin / jx,
            spin / jy,
        ],
        axis=1,
    )


def evaluated(expressions, states):
    """A symbolic matrix at each state, (flights, rows, columns)."""
    x, speeds = states
    symbols = (*equations.STATE, *equations.LOADS, *equations.INERTIA, equations.GRAVITY)
    function = sympy.lambdify(symbols, expressions, "numpy")
    constants = (*FRAME.inertia, FRAME.gravity)
    return np.array(
        [function(*state, *load, *constants) for state, load in zip(x, loads(speeds), strict=True)]
    )


def test_derivative(states):
    wanted = evaluated(equations.derivative(), states)[:, :, 0]
    np.testing.assert_allclose(model.derivative(FRAME, *states), wanted, rtol=1e-12, atol=1e-12)


def test_jacobian_entry_by_entry(states):
    symbolic, computed = equations.jacobian(), model.derivative_jacobian(FRAME, *states)
    assert symbolic[:, model.CORE :].is_zero_matrix  # the position drives nothing
    wanted = evaluated(symbolic, states)
    for i, of in enumerate(equations.STATE):
        for j, by in enumerate(equations.STATE[: model.CORE]):
            np.testing.assert_allclose(
                computed[:, i, j],
                wanted[:, i, j],
                rtol=1e-11,
                atol=1e-12,
                err_msg=f"d(d{of}/dt)/d{by}",
            )
