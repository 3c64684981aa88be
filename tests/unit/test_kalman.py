"""The component-wise Kalman steps against plain matrix algebra on random systems."""

import numpy as np
import pytest

from repro.filters.families import kalman
from repro.models import Model
from repro.models.sparse import combine, dense, rows

SYSTEMS = 4


def covariance(generator, n):
    root = generator.normal(size=(n, n))
    return root @ root.T


def random_model(generator, n, m):
    transition, measurement = generator.normal(size=(n, n)), generator.normal(size=(m, n))
    transition[0, 0], transition[0, -1], measurement[0, 0] = 1.0, 0.0, 0.0
    return (
        Model(
            transition=lambda x, k: x @ transition.T,
            transition_jacobian=lambda x, k: rows(transition),
            measurement=lambda x, sensor: x @ measurement.T,
            measurement_jacobian=lambda x, sensor: rows(measurement),
            process_covariance=covariance(generator, n),
            measurement_covariance=covariance(generator, m),
            initial_mean=generator.normal(size=n),
            initial_covariance=covariance(generator, n),
        ),
        transition,
        measurement,
    )


def unpacked(packed, n):
    return packed[kalman.packed_places(n)]


@pytest.mark.parametrize(("n", "m"), [(2, 1), (3, 3), (6, 2), (12, 12)])
def test_a_step_is_the_kalman_filters(n, m):
    """R is not diagonal and A is dense: nothing relies on the structure of the paper's examples."""
    generator = np.random.default_rng(n)
    model, a, c = random_model(generator, n, m)
    x, p = kalman.start(model, SYSTEMS)
    x += generator.normal(size=x.shape)
    received = generator.normal(size=(SYSTEMS, m))
    weight = np.array([0.0, 1.0, 0.3, 1.0])
    predicted, packed = kalman.predict(model, x, p, 0)
    innovation = kalman.innovate(model, predicted, packed, received)
    likelihood = kalman.log_likelihood(innovation)
    noise = kalman.noise_log_likelihood(model)(received)
    estimate, corrected = kalman.correct(
        predicted.copy(), packed.copy(), innovation, weight, spread=True
    )
    r, sigma = model.measurement_covariance, a @ model.initial_covariance @ a.T
    sigma += model.process_covariance
    s = c @ sigma @ c.T + r
    gain = sigma @ c.T @ np.linalg.inv(s)
    for i in range(SYSTEMS):
        mean = a @ x[:, i]
        e = received[i] - c @ mean
        g, correction = weight[i], gain @ e
        np.testing.assert_allclose(predicted[:, i], mean, rtol=1e-12)
        np.testing.assert_allclose(unpacked(packed, n)[..., i], sigma, rtol=1e-10, atol=1e-10)
        np.testing.assert_allclose(estimate[:, i], mean + g * correction, rtol=1e-9, atol=1e-9)
        wanted = sigma - g * gain @ c @ sigma + g * (1 - g) * np.outer(correction, correction)
        np.testing.assert_allclose(unpacked(corrected, n)[..., i], wanted, rtol=1e-8, atol=1e-8)
        for computed, value, matrix in ((likelihood, e, s), (noise, received[i], r)):
            density = value @ np.linalg.solve(matrix, value) + np.linalg.slogdet(matrix)[1]
            assert computed[i] == pytest.approx(-0.5 * density)


def test_sparse_rows():
    matrix = np.array([[1.0, 0.0, 2.0], [0.0, 0.0, 0.0], [0.5, 1.0, 1.0]])
    slabs = np.arange(12.0).reshape(3, 4)
    computed = np.empty((3, 4))
    for row, out in zip(rows(matrix), computed, strict=True):
        combine(row, slabs, out)
    np.testing.assert_array_equal(computed, matrix @ slabs)
    np.testing.assert_array_equal(dense(rows(matrix), (2,), 3), np.stack([matrix, matrix]))
