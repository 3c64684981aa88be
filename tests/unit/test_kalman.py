"""The compiled Kalman steps against plain matrix algebra on random systems."""

import numpy as np
import pytest

from repro.filters.families import kalman
from repro.kernels.kalman_step import PART
from repro.models import Model
from repro.models.sparse import dense

SYSTEMS = 4


def covariance(generator, n):
    root = generator.normal(size=(n, n))
    return root @ root.T


def of_rows(matrix, systems):
    """A Jacobian as sparse rows in which every other entry is an array over the systems."""
    return [
        {j: np.full(systems, x) if j % 2 else x for j, x in enumerate(row) if x != 0}
        for row in matrix
    ]


FORMS = {
    "constant": lambda matrix, systems: matrix,
    "of each system": lambda matrix, systems: np.tile(matrix, (systems, 1, 1)),
    "rows": of_rows,
}


def random_model(generator, n, m, form):
    transition, measurement = generator.normal(size=(n, n)), generator.normal(size=(m, n))
    transition[0, 0], transition[0, -1], measurement[0, 0] = 1.0, 0.0, 0.0
    return (
        Model(
            transition=lambda x, k: np.matvec(transition, x),
            transition_jacobian=lambda x, k: form(transition, len(x)),
            measurement=lambda x, sensor: np.matvec(measurement, x),
            measurement_jacobian=lambda x, sensor: form(measurement, len(x)),
            process_covariance=covariance(generator, n),
            measurement_covariance=covariance(generator, m),
            initial_mean=generator.normal(size=n),
            initial_covariance=covariance(generator, n),
        ),
        transition,
        measurement,
    )


def unpacked(packed, n):
    matrices = np.empty((n, n, packed.shape[1]))
    rows, columns = np.triu_indices(n)
    matrices[rows, columns] = matrices[columns, rows] = packed
    return matrices


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(("n", "m"), [(2, 1), (3, 3), (6, 2), (12, 12)])
def test_a_step_is_the_kalman_filters(n, m, form):
    """R is not diagonal and A is dense: nothing relies on the structure of the paper's examples."""
    generator = np.random.default_rng(n)
    model, a, c = random_model(generator, n, m, FORMS[form])
    x, p = kalman.start(model, SYSTEMS)
    x += generator.normal(size=x.shape)
    received = generator.normal(size=(SYSTEMS, m))
    weight = np.array([0.0, 1.0, 0.3, 1.0])
    predicted, packed = kalman.predict(model, x, p, 0)
    innovation = kalman.innovate(model, predicted, packed, received)
    likelihood = innovation.log_likelihood
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


def test_dense_matrices_of_rows():
    matrix = np.array([[1.0, 0.0, 2.0], [0.0, 0.0, 0.0], [0.5, 1.0, 1.0]])
    np.testing.assert_array_equal(dense(of_rows(matrix, 2), (2,), 3), np.stack([matrix, matrix]))


def test_many_systems_are_each_alone():
    """More than the kernels work through at once, and some left over."""
    generator = np.random.default_rng(0)
    model, _, _ = random_model(generator, 3, 2, of_rows)
    x, p = kalman.start(model, 2 * PART + 5)
    x += generator.normal(size=x.shape)
    received = generator.normal(size=(x.shape[1], 2))

    def step(systems):
        state = kalman.predict(model, x[:, systems].copy(), p[:, systems].copy(), 0)
        innovation = kalman.innovate(model, *state, received[systems])
        return np.concatenate(kalman.correct(*state, innovation, 0.4, spread=True))

    together = step(slice(None))
    for i in (0, PART - 1, PART, 2 * PART + 4):
        np.testing.assert_array_equal(together[:, i : i + 1], step(slice(i, i + 1)))
