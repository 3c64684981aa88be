"""The coordinated turn and the range of [packet_delays (40)-(42)]."""

import numpy as np
import pytest

from repro.kernels import turn_and_schedule
from repro.models import coordinated_turn as model
from repro.models.sparse import dense

STATES = np.array(
    [
        [30, 70, 20, 20, -1],
        [3, -7, 2, -5, 2.5],
        [1, 2, 3, 4, 1e-7],
        [1, 2, 3, 4, 0.0],
        [0, 0, 5, 1, 5e-3],
    ]
)


def central_difference(function, x, step=1e-6):
    columns = []
    for i in range(len(x)):
        offset = np.zeros(len(x))
        offset[i] = step
        columns.append((function(x + offset) - function(x - offset)) / (2 * step))
    return np.stack(columns, axis=-1)


@pytest.mark.parametrize("time", [0.1, 1.0])
@pytest.mark.parametrize("x", STATES)
def test_transition_jacobian(x, time):
    jacobian = dense(model.transition_jacobian(x, time), (), len(x))
    numerical = central_difference(lambda s: model.transition(s, time), x)
    np.testing.assert_allclose(jacobian, numerical, rtol=1e-5, atol=1e-6)
    assert np.linalg.det(jacobian) == pytest.approx(1)


@pytest.mark.parametrize("x", STATES)
def test_distance_jacobian(x):
    sensor = np.array([45.0, 12.0])
    numerical = central_difference(lambda s: model.distance(s, sensor), x)
    np.testing.assert_allclose(
        dense(model.distance_jacobian(x, sensor), (), len(x))[0], numerical, atol=1e-6
    )


def test_series_and_quotients_agree_where_they_meet():

    def jacobian(x, time):
        return dense(model.transition_jacobian(x, time), (), len(x))

    for function in (model.transition, jacobian):
        edge = turn_and_schedule.SERIES_BELOW
        below, above = ([1.0, 2.0, 3.0, 4.0, edge * f] for f in (1 - 1e-9, 1 + 1e-9))
        np.testing.assert_allclose(
            function(np.array(below), 1.0), function(np.array(above), 1.0), rtol=1e-7
        )


def test_without_noise_the_target_stays_on_its_circle():
    x = STATES[0]
    for _ in range(65):
        x = model.transition(x, 0.1)
        assert np.hypot(x[0] - 50, x[1] - 50) == pytest.approx(np.sqrt(800))
        assert np.hypot(x[2], x[3]) == pytest.approx(np.sqrt(800))


def test_jacobian_on_a_sensor_is_finite():
    row = model.distance_jacobian(STATES[0], STATES[0][:2])
    assert np.isfinite(dense(row, (), 5)).all()
