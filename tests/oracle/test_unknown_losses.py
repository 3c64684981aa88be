"""The filters of the unknown-losses paper against exact computations."""

from fractions import Fraction
from itertools import product

import numpy as np
import pytest
from scipy.stats import multivariate_normal

from repro import plugins
from repro.models.sparse import dense
from repro.papers.unknown_losses import operation_counts
from repro.runner import run
from tests.conftest import points, small_log

RBPF = points()["linear_losses"]["loss=0.5"].filters["rbpf"]
THETA = {"prior": "theta"}
SETTINGS = {"rbpf": RBPF, "rbpf_fast": RBPF, "bkf_2": THETA}


def filtered(log, name, **changes):
    """Estimates and runs of a filter with the default settings, changed."""
    return run(log, name, SETTINGS.get(name, {}) | changes)


def with_parameters(log, **changes):
    return log._replace(parameters=log.parameters.model_copy(update=changes))


def log_of(received, **changes):
    """A log of the linear study in which y is given and nothing is known of the truth."""
    log = small_log("linear_losses", "loss=0.5", trials=1, steps=len(received))
    values = log.values | {"/received": np.array(received, dtype=float)[None, :, None]}
    return with_parameters(log._replace(values=values), **changes)


@pytest.mark.parametrize("name", ["iekf", "bkf_1", "bkf_2", "rbpf", "rbpf_fast", "exact"])
@pytest.mark.parametrize("study", ["linear_losses", "radar"])
def test_without_losses_every_filter_is_the_kalman_filter(study, name):
    log = with_parameters(small_log(study, "loss=0.5", steps=6), loss_probability=0.0)
    sent = log.values | {"/received": log.values["/sensor"]}
    sent["/network"] = np.ones_like(sent["/network"])
    log = log._replace(values=sent)
    estimate, wanted = filtered(log, name)[0], filtered(log, "ekf")[0]
    np.testing.assert_allclose(estimate, wanted, rtol=1e-10, atol=1e-10)


def test_if_everything_is_lost_nothing_is_used():
    log = with_parameters(small_log("linear_losses", "loss=0.5"), loss_probability=1.0)
    for name in ("bkf_1", "bkf_2", "rbpf", "rbpf_fast", "exact"):
        np.testing.assert_array_equal(filtered(log, name)[0], 0.0)


def test_two_steps_by_hand():
    """xh(1|1) of the Kalman filter on y = 1, -2 in exact fractions."""
    f = [[Fraction(3, 5), Fraction(2, 5)], [Fraction(1, 10), Fraction(9, 10)]]
    h = [Fraction(1), Fraction(-2)]
    x, p = [Fraction(0)] * 2, [[Fraction(1), Fraction(0)], [Fraction(0), Fraction(1)]]
    two = range(2)

    def times(a, b):
        return [[sum(a[i][k] * b[k][j] for k in two) for j in two] for i in two]

    for step, y in enumerate((Fraction(1), Fraction(-2))):
        if step:
            x = [sum(f[i][j] * x[j] for j in two) for i in two]
            p = times(times(f, p), [[f[j][i] for j in two] for i in two])
            p = [[p[i][j] + (i == j) for j in two] for i in two]
        cross = [sum(p[i][j] * h[j] for j in two) for i in two]
        s = sum(h[i] * cross[i] for i in two) + 1
        e = y - sum(h[i] * x[i] for i in two)
        x = [x[i] + cross[i] * e / s for i in two]
        p = [[p[i][j] - cross[i] * cross[j] / s for j in two] for i in two]
    assert x == [Fraction(-331, 962), Fraction(1213, 1924)]
    estimate, runs = filtered(log_of([1, -2]), "ekf")
    np.testing.assert_allclose(estimate[0, 1], [float(v) for v in x], rtol=1e-14)
    np.testing.assert_allclose(runs.claimed[0, 1], [float(p[i][i]) for i in two], rtol=1e-14)


def test_filterpy_agrees_on_the_plain_update():
    kalman = pytest.importorskip("filterpy.kalman")
    log = small_log("linear_losses", "loss=0.5", trials=2, steps=50)
    model = plugins.study("linear_losses").model(log.parameters)
    estimate = filtered(log, "ekf")[0]
    for trial, received in enumerate(log.values["/received"]):
        other = kalman.KalmanFilter(dim_x=2, dim_z=1)
        other.x, other.P = model.initial_mean[:, None].copy(), model.initial_covariance.copy()
        other.F = dense(model.transition_jacobian(None, 0), (), 2)
        other.H = dense(model.measurement_jacobian(None, None), (), 2)
        other.Q, other.R = model.process_covariance, model.measurement_covariance
        for k, y in enumerate(received):
            if k:
                other.predict()
            other.update(y[:, None])
            np.testing.assert_allclose(estimate[trial, k], other.x[:, 0], rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("name", ["iekf", "bkf_1", "bkf_2"])
@pytest.mark.parametrize("study", ["linear_losses", "radar"])
def test_the_printed_algorithms_agree(study, name):
    """Each filter against its algorithm written out in plain matrix algebra, step by step."""
    log = small_log(study, "loss=0.5", trials=4, steps=40)
    scenario, estimate = plugins.study(study), filtered(log, name)[0]
    model = scenario.model(log.parameters)
    n, first = len(model.initial_mean), scenario.first_step(log.parameters)
    for trial in range(4):
        x, sigma = model.initial_mean, model.initial_covariance
        for k in range(first, estimate.shape[1]):
            count = operation_counts.Operations()
            if k > 0:
                a = dense(model.transition_jacobian(x, k - 1), (), n)
                x = model.transition(x, k - 1)
                sigma = count.time_update(sigma, a, model.process_covariance)
            y = log.values["/received"][trial, k]
            innovation = model.innovation(y, model.measurement(x, None))
            c = dense(model.measurement_jacobian(x, None), (), n)
            at = operation_counts.Linearised(innovation, c, model.measurement_covariance, y)
            known = log.values["/network"][trial, k, 0] if name == "iekf" else 0.5
            x, sigma = getattr(operation_counts, name)(count, x, sigma, at, known)
            np.testing.assert_allclose(estimate[trial, k], x, rtol=1e-6, atol=1e-6)
            assert count.products == (9 if name == "bkf_2" else 7) - (2 if k == 0 else 0)


def conditional_moments(log, theta):
    """Mean and variances of x(K) given y, as the mixture over all loss sequences.

    Each sequence is one joint Gaussian of (x(K), y(0) ... y(K)), without any recursion.
    """
    p = log.parameters
    f, h = np.array(p.transition_matrix), np.array(p.measurement_row)
    y = log.values["/received"][0, :, 0]
    steps = len(y)
    powers = [np.linalg.matrix_power(f, i) for i in range(steps)]
    blocks = [
        np.hstack([powers[k - s] if s <= k else np.zeros((2, 2)) for s in range(steps)])
        for k in range(steps)
    ]  # x(k) of x(0), w(0), ..., all of unit covariance
    last = blocks[-1]
    weights, means, variances = [], [], []
    for gamma in product((0, 1), repeat=steps):
        rows = np.array([g * (h @ block) for g, block in zip(gamma, blocks, strict=True)])
        s = rows @ rows.T + np.eye(steps)
        gain = last @ rows.T @ np.linalg.inv(s)
        prior = np.prod([theta if g else 1 - theta for g in gamma])
        weights.append(prior * multivariate_normal.pdf(y, np.zeros(steps), s))
        means.append(gain @ y)
        variances.append(np.diag(last @ last.T - gain @ rows @ last.T))
    weights = np.array(weights) / np.sum(weights)
    mean = weights @ np.array(means)
    return mean, weights @ (np.array(variances) + (np.array(means) - mean) ** 2)


def test_exact_is_the_mixture_over_all_sequences():
    log = log_of([1, -2, 0.5, 3, -1], loss_probability=0.3)
    estimate, runs = filtered(log, "exact")
    mean, variance = conditional_moments(log, 0.7)
    np.testing.assert_allclose(estimate[0, -1], mean, rtol=1e-10)
    np.testing.assert_allclose(runs.claimed[0, -1], variance, rtol=1e-10)


def test_bkf_2_is_exact_at_the_first_step():
    log = small_log("linear_losses", "loss=0.3", trials=20)
    (estimate, runs), (wanted, exact) = (filtered(log, name) for name in ("bkf_2", "exact"))
    np.testing.assert_allclose(estimate[:, 0], wanted[:, 0], rtol=1e-12)
    np.testing.assert_allclose(runs.claimed[:, 0], exact.claimed[:, 0], rtol=1e-12)
    assert np.abs(estimate[:, 1:] - wanted[:, 1:]).max() > 1e-3  # and not after it


def test_exact_claims_what_it_errs():
    log = small_log("linear_losses", "short-loss=0.3", trials=2000, steps=7)
    _, runs = filtered(log, "exact")
    normalised = (runs.error**2 / runs.claimed).mean(axis=(0, 1))
    np.testing.assert_allclose(normalised, 1.0, atol=0.06)


@pytest.mark.parametrize("changes", [{}, {"proposal": "optimal"}, {"resampling": "systematic"}])
def test_rbpf_approaches_the_exact_estimate_like_root_n(changes):
    log = small_log("linear_losses", "short-loss=0.3", trials=400, steps=8)
    exact = filtered(log, "exact")[0]

    def distance(particles):
        estimate = filtered(log, "rbpf_fast", particles=particles, **changes)[0]
        return np.sqrt(((estimate - exact) ** 2).mean())

    few, many = distance(64), distance(64 * 16)
    assert 2.5 < few / many < 6  # 4 in the limit
    assert many < 0.05


@pytest.mark.parametrize("process", ["Bernoulli", "Markov"])
def test_rbpf_approaches_one_ekf_a_sequence_on_the_radar(process):
    """Markov too: there the particles' priors differ."""
    log = with_parameters(small_log("radar", "loss=0.5", trials=60, steps=6), loss_process=process)
    exact = filtered(log, "exact")[0]
    few, many = (
        np.abs(filtered(log, "rbpf_fast", particles=n)[0] - exact)[:, -1].max(axis=-1)
        for n in (30, 3000)
    )
    # Most trials agree at once; the others had thought a sequence hopeless that was not.
    assert np.median(many) < 1e-6
    assert np.quantile(many, 0.9) < 0.2 * np.quantile(few, 0.9)


@pytest.mark.parametrize("process", ["Bernoulli", "Markov"])
@pytest.mark.parametrize("study", ["linear_losses", "radar"])
@pytest.mark.parametrize(
    "changes",
    [{}, {"proposal": "optimal"}, {"resampling": "systematic", "threshold": 1.0}],
)
def test_fast_rbpf_is_the_rbpf_to_the_last_bit(study, process, changes):
    log = with_parameters(small_log(study, "loss=0.5", trials=7, steps=30), loss_process=process)
    (estimate, fast), (wanted, plain) = (
        filtered(log, name, particles=50, **changes) for name in ("rbpf_fast", "rbpf")
    )
    np.testing.assert_array_equal(estimate, wanted)
    if plain.claimed is not None:
        np.testing.assert_array_equal(fast.claimed, plain.claimed)
    assert fast.recorded["triples"].mean() < 45


def test_markov_losses_without_memory_are_bernoulli():
    log = small_log("linear_losses", "loss=0.3", trials=5, steps=30)
    markov = with_parameters(
        log, loss_process="Markov", loss_after_arrival=0.3, arrival_after_loss=0.7
    )
    for name in ("bkf_1", "bkf_2", "rbpf", "rbpf_fast"):
        np.testing.assert_allclose(
            filtered(markov, name)[0], filtered(log, name)[0], rtol=1e-12, atol=1e-12
        )


def test_ikf_errs_as_its_covariance_says():
    log = small_log("linear_losses", "loss=0.5", trials=2000, steps=40)
    _, runs = filtered(log, "iekf")
    squared, claimed = (runs.error**2).sum(axis=-1), runs.claimed.sum(axis=-1)
    difference = (squared - claimed).mean(axis=1)
    assert abs(difference.mean()) < 4 * difference.std() / np.sqrt(len(difference))
    assert difference.std() / np.sqrt(len(difference)) < 0.02 * claimed.mean()


def test_bkf_2_with_its_literal_prior_becomes_the_kalman_filter():
    """Below (11) lambda is its own prior: after some steps it stays at 1 (or 0)."""
    log = small_log("linear_losses", "loss=0.3", trials=200, steps=200)
    literal = filtered(log, "bkf_2", prior="lambda(k-1)")[0][:, -1]
    distance = np.abs(literal - filtered(log, "ekf")[0][:, -1]).max(axis=-1)
    assert (distance < 1e-3).mean() > 0.95


def test_table_1_is_counted():
    rows = operation_counts.table_1(n=6, m=2, particles=20)
    counted = {(row["filter"], row["component"]): row["value"] for row in rows}
    assert counted["iekf", "densities"] == 0
    assert counted["iekf", "products"] == counted["bkf_1", "products"] == 7
    assert counted["bkf_2", "products"] == 9
    assert counted["bkf_1", "densities"] == counted["bkf_2", "densities"] == 2
    assert counted["rbpf", "densities"] == 20  # the paper says 2 N
    assert counted["rbpf", "products"] == 20 * 7
    assert counted["bkf_2", "order_in_n"] == pytest.approx(3, abs=0.05)


def test_multiplications_are_those_of_the_matrices():
    count = operation_counts.Operations()
    count.product(np.ones((2, 3)), np.ones((3, 5)))
    assert (count.products, count.multiplications) == (1, 30)
    assert operation_counts.order(30, 240) == pytest.approx(3)


@pytest.mark.parametrize("process", ["Bernoulli", "Markov"])
def test_the_standard_particle_filter_approaches_the_exact_estimate(process):
    log = small_log("linear_losses", "short-loss=0.3", trials=300, steps=6)
    log = with_parameters(log, loss_process=process)
    exact = filtered(log, "exact")[0]
    few, many = (
        np.sqrt(((filtered(log, "sir_losses", particles=n)[0] - exact) ** 2).mean())
        for n in (256, 16 * 256)
    )
    assert 2.5 < few / many < 6  # 4 in the limit
    assert many < 0.1


GOLDEN = {
    "ekf": [0.31802691454248455, -1.121492579680414],
    "bkf_1": [0.30921151816674197, -1.128693690713252],
    "bkf_2": [0.23532622973765246, -1.1430901809877463],
    "exact": [0.2631059694281455, -1.1228641045146364],
}


@pytest.mark.parametrize("name", GOLDEN)
def test_recorded_estimates(name):
    """xh(3|3) on y = 1, -2, 0.5, 3 with p = 0.3, to compare other implementations with."""
    estimate = filtered(log_of([1, -2, 0.5, 3], loss_probability=0.3), name)[0]
    np.testing.assert_allclose(estimate[0, -1], GOLDEN[name], rtol=1e-11)
