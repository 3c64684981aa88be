import numpy as np
import pytest

from repro import plugins
from repro.models import radar
from repro.models.linear_system import product, root
from repro.models.sparse import dense
from repro.simulate import simulated
from tests.conftest import points


@pytest.mark.parametrize("position", [(10, 10), (-300, 20), (5, -700), (-1, -2)])
def test_measurement_jacobian(position):
    x = np.array([position[0], 1.0, 2.0, position[1], 3.0, 4.0])
    step = 1e-6 * np.eye(6)
    numerical = [
        (radar.measurement(x + d, "atan2") - radar.measurement(x - d, "atan2")) / 2e-6 for d in step
    ]
    jacobian = dense(radar.measurement_jacobian(x), (), 6)
    np.testing.assert_allclose(jacobian, np.transpose(numerical), rtol=1e-6, atol=1e-7)


def test_bearing_is_wrapped_to_half_open_interval():
    received = np.array([[5.0, 3.1], [5.0, -3.1], [5.0, np.pi]])
    expected = np.array([[4.0, -3.1], [4.0, 3.1], [4.0, 0.0]])
    innovation = radar.wrapped_innovation(received, expected)
    np.testing.assert_allclose(innovation[:, 0], 1.0)
    turn = 6.2 - 2 * np.pi
    np.testing.assert_allclose(innovation[:, 1], [turn, -turn, -np.pi], atol=1e-12)


def test_motion_is_that_of_constant_acceleration():
    x = np.array([1.0, 2.0, 3.0, -1.0, -2.0, 0.5])
    moved = product(radar.transition_matrix(0.1), x)
    np.testing.assert_allclose(moved, [1.215, 2.3, 3.0, -1.1975, -1.95, 0.5])


def test_covariances_are_those_of_the_paper():
    """Q by quadrature of the continuous model, Sigma_0 singular with its printed entries."""
    period, alpha, sigma = 0.01, 1.0, 4.0
    times = (np.arange(2000) + 0.5) * period / 2000
    response = np.stack([times**2 / 2, times, np.ones_like(times)])
    wanted = 2 * alpha * sigma**2 * (response @ response.T) * period / 2000
    q = radar.process_covariance(period, alpha, sigma)
    np.testing.assert_allclose(q[:3, :3], wanted, rtol=1e-5)
    np.testing.assert_array_equal(q[:3, 3:], 0.0)
    prior = radar.initial_covariance(period, 5.0)
    assert np.sqrt(prior[1, 1]) == pytest.approx(707.1, abs=0.01)
    assert np.linalg.matrix_rank(prior) == 4
    for covariance in (q, prior):  # both as LAPACK has them
        values, vectors = np.linalg.eigh(covariance)
        wanted = (vectors * np.sqrt(np.maximum(values, 0.0))) @ vectors.T
        np.testing.assert_allclose(root(covariance), wanted, atol=1e-13 * wanted.max())


def test_the_filters_know_the_input_that_drives_the_truth():
    changes = {"known_input": (0.0, 1.0, 0.2), "manoeuvre_deviation": 0.0, "steps": 9}
    parameters = points()["radar"]["loss=0.5"].parameters.model_copy(update=changes)
    truth = simulated("radar", "loss=0.5", parameters, 1, np.arange(2)).values["/truth"]
    predicted = plugins.study("radar").model(parameters).transition(truth[:, :-1], 0)
    np.testing.assert_allclose(truth[:, 1:], predicted, rtol=1e-13)
    assert truth[0, -1, 2] == pytest.approx(9 * 0.2)
