"""Rigid body, motors, controller, mixing and path against exact statements and points by hand."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from repro.control import cascaded_pid, path
from repro.errors import ReproError
from repro.inspect.user_log import open_loop
from repro.kernels import quadrotor_flight as flight
from repro.models import quadrotor as model
from repro.studies import quadrotor as study
from tests.conftest import points

PARAMETERS = points()["quadrotor"]["nominal"].parameters
FRAME, MOTOR = study.airframe(PARAMETERS), study.motor(PARAMETERS)
SETTINGS = study.controller(PARAMETERS)
PERIOD = PARAMETERS.period


def states(count=6, seed=3):
    """States all over the flight envelope, and rotor speeds."""
    random = np.random.default_rng(seed)
    x = random.standard_normal((count, 12)) * np.repeat([2.0, 0.5, 3.0, 5.0], 3)
    x[:, 11] += 40
    return x, 4100 + 500 * random.standard_normal((count, 4))


def momentum_and_energy(x):
    """Angular momentum in the inertial frame (count, 3), and energy (count,)."""
    inertia = np.array(FRAME.inertia)
    turned = Rotation.from_euler("ZYX", x[:, [5, 4, 3]])
    kinetic = FRAME.mass * (x[:, 6:9] ** 2).sum(1) + (inertia * x[:, :3] ** 2).sum(1)
    return turned.apply(inertia * x[:, :3]), kinetic / 2 + FRAME.mass * FRAME.gravity * x[:, 11]


def fly(x, speeds, period, steps):
    for _ in range(steps):
        x = model.transition(FRAME, x, speeds, period)
    return x


def test_hover_is_an_equilibrium():
    speed = model.hover_speed(FRAME)
    assert speed == pytest.approx(4108.28, abs=0.005)
    assert MOTOR.hover_throttle(speed) == pytest.approx(38.8672, abs=5e-5)
    at_rest = np.array([0] * 5 + [0.7] + [0] * 3 + [1.0, -2.0, 3.0])
    speeds = np.full(4, speed)
    assert np.abs(model.derivative(FRAME, at_rest, speeds)).max() < 1e-12
    after = model.transition(FRAME, at_rest, speeds, PERIOD)
    np.testing.assert_allclose(after, at_rest, rtol=0, atol=1e-12)


def test_without_thrust_momentum_and_energy_stay():
    """Free fall: torques and thrust are zero, gravity is the only force."""
    x, speeds = states()[0], np.zeros((6, 4))
    after = fly(x, speeds, 0.002, 100)
    for before_, after_ in zip(momentum_and_energy(x), momentum_and_energy(after), strict=True):
        np.testing.assert_allclose(after_, before_, rtol=1e-8, atol=1e-9)


def test_without_thrust_the_centre_of_mass_falls_freely():
    x = states()[0]
    velocity = Rotation.from_euler("ZYX", x[:, [5, 4, 3]]).apply(x[:, 6:9])
    after = fly(x, np.zeros((6, 4)), 0.002, 100)
    fallen = velocity * 0.2 - [0, 0, FRAME.gravity * 0.2**2 / 2]
    np.testing.assert_allclose(after[:, 9:], x[:, 9:] + fallen, atol=1e-7)


def test_thrust_acts_along_the_body_axis_and_torques_about_theirs():
    """One rotor faster by d: torque d ct (w^2), and the reaction on yaw, by hand."""
    x = np.zeros(12)
    x[11] = 3
    base = np.full(4, 4000.0)
    rates = []
    for rotor in range(4):
        speeds = base.copy()
        speeds[rotor] = 4200.0
        rates.append(model.derivative(FRAME, x, speeds)[:3])
    extra = 4200.0**2 - 4000.0**2
    roll = 0.22225 * 1.4865e-7 * extra / 0.0094999
    yaw = 2.925e-9 * extra / 0.018576
    expected = [[0, -roll, -yaw], [roll, 0, yaw], [0, roll, -yaw], [-roll, 0, yaw]]
    np.testing.assert_allclose(rates, expected, rtol=1e-12)


def test_gyroscopic_torque_of_the_rotors_is_minus_omega_cross_h():
    """The drag of rotors 2 and 4 turns the body to +z, so that they themselves turn to -z."""
    x = np.zeros(12)
    x[:2] = 0.4, -0.3
    x[11] = 3
    speeds = np.array([4000.0, 4500.0, 4000.0, 4500.0])
    spin = 3.788222486e-6 * 2 * np.pi / 60 * 1000.0
    expected = -np.cross(x[:3], [0, 0, -spin])[:2] / 0.0094999
    np.testing.assert_allclose(model.derivative(FRAME, x, speeds)[:2], expected, rtol=1e-12)


def test_rk4_is_of_fourth_order():
    """Halving the step divides the error by sixteen."""
    x, speeds = states(count=3)
    exact = fly(x, speeds, 0.08 / 64, 64)
    errors = [np.abs(fly(x, speeds, 0.08 / n, n) - exact).max() for n in (2, 4, 8)]
    ratios = np.array(errors[:-1]) / errors[1:]
    assert ((ratios > 13) & (ratios < 20)).all(), ratios


def test_jacobian_by_central_differences():
    x, speeds = states()
    after, jacobian = model.linearised(FRAME, x, speeds, PERIOD)
    np.testing.assert_array_equal(after, model.transition(FRAME, x, speeds, PERIOD))
    for i, offset in enumerate(1e-5 * np.eye(12)):
        up, down = (model.transition(FRAME, x + s * offset, speeds, PERIOD) for s in (1, -1))
        np.testing.assert_allclose(jacobian[..., i], (up - down) / 2e-5, atol=2e-8, rtol=1e-7)


def test_the_ground():
    x = np.zeros((2, 12))
    x[:, 8] = -1.0  # falling
    x[:, 11] = 0.005, 0.0
    after, jacobian = model.linearised(FRAME, x, np.zeros((2, 4)), PERIOD)
    np.testing.assert_array_equal(after[:, 11], 0.0)
    np.testing.assert_array_equal(jacobian[:, 11], 0.0)
    rising = np.zeros(12)
    rising[8] = 1.0
    assert model.transition(FRAME, rising, np.full(4, 4200.0), PERIOD)[11] > 0.009


def test_motor_is_a_first_order_lag():
    throttle = np.array([50.0, 4.9, 120.0, -3.0])
    steady = np.array([80.584 * 50 + 976.2, 0.0, 80.584 * 100 + 976.2, 0.0])
    after = model.motor_step(MOTOR, np.full(4, 4000.0), throttle, 0.076)
    np.testing.assert_allclose(after, steady + (4000 - steady) / np.e)
    two = model.motor_step(MOTOR, after, throttle, 0.03)
    once = model.motor_step(MOTOR, np.full(4, 4000.0), throttle, 0.106)
    np.testing.assert_allclose(two, once)


def commanded(memory, estimate, reference):
    """Commands of the controller for one flight: tilts, then roll, pitch, yaw and altitude."""
    commands = np.empty(6)
    (integrals,), (last,) = memory
    limits = SETTINGS.limits()
    flight.control(
        SETTINGS.gains(), limits, integrals, last, estimate[0], reference, PERIOD, commands
    )
    return commands


def test_controller_at_a_point_by_hand():
    """Heading 90 deg: the north error is ahead. Two steps, so that integrals and rates act."""
    estimate = np.array([[0.1, -0.2, 0.3, 0.02, -0.01, np.pi / 2, 0.05, -0.04, 0.0, 1.0, 2.0, 2.5]])
    reference = np.array([0.7, 2.2, 3.0, np.pi / 2 + 0.1])
    memory = cascaded_pid.start(estimate)
    first = commanded(memory, estimate, reference)
    tilt_pitch = 0.32 * (0.2 - 0.05)  # Yc - Y is ahead
    tilt_roll = -0.32 * (0.3 + 0.04)  # X - Xc is to the left
    expected = [
        tilt_roll,
        tilt_pitch,
        2 * (tilt_roll - 0.02) - 1.2 * 0.1,
        2 * (tilt_pitch + 0.01) + 1.2 * 0.2,
        4 * 0.1 - 3.5 * 0.3,
    ]
    np.testing.assert_allclose(first[:5], expected)
    np.testing.assert_allclose(first[5], 38.8672 + 2 * 0.5, rtol=2e-6)
    later = estimate.copy()
    later[0, [6, 7, 11]] += 0.01, -0.005, 0.004  # 1 m/s^2, -0.5 m/s^2, 0.4 m/s
    second = commanded(memory, later, reference)
    np.testing.assert_allclose(second[1], 0.32 * (0.2 - 0.06) - 0.1 * 1.0)
    np.testing.assert_allclose(second[0], -(0.32 * (0.3 + 0.045) + 0.1 * 0.5))
    climb = 2 * 0.496 + 1.1 * 0.5 * PERIOD - 3.3 * 0.4
    np.testing.assert_allclose(second[5], 38.8672 + climb, rtol=2e-6)
    np.testing.assert_allclose(memory.integrals[0, 2], 2 * 0.1 * PERIOD)


def test_commands_and_integrals_are_limited():
    estimate = np.zeros((1, 12))
    memory = cascaded_pid.start(estimate)
    for _ in range(3):
        commands = commanded(memory, estimate, np.array([50.0, 50.0, 90.0, 0.0]))
    np.testing.assert_allclose(commands[:2], [-np.deg2rad(12), np.deg2rad(12)])
    np.testing.assert_allclose(memory.integrals[0, 3], 1.0)  # 3 * 0.9 m s, limited


def test_mixing_by_hand():
    throttle = np.empty(4)  # of tilts, which do not matter, roll 1, pitch 2, yaw 4, altitude 40
    flight.mix(np.array([0.0, 0.0, 1.0, 2.0, 4.0, 40.0]), throttle)
    np.testing.assert_array_equal(throttle, [34, 45, 38, 43])


def test_path_is_linear_and_held():
    flown = study.reference(PARAMETERS)
    for second, point in {
        0: (0, 0),
        2.5: (0.5, 0),
        7.5: (1, 0.5),
        12: (0.2, 0.6),
        34: (0, 0),
    }.items():
        np.testing.assert_allclose(flown[round(second / PERIOD)], [*point, 3, 0], atol=1e-12)
    np.testing.assert_allclose(
        path.reference([0, 1], [[0.0], [2.0]], np.array([0.25, 9])), [[0.5], [2]]
    )


def test_no_log_recorded_elsewhere_can_be_filtered_in_a_closed_loop():
    with pytest.raises(ReproError, match="quadrotor: a closed loop") as error:
        open_loop("quadrotor")
    assert "\n" not in str(error.value)
