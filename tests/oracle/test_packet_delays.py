"""The filters of the packet-delay paper against exact computations."""

import numpy as np
import pytest
from scipy.linalg import solve_discrete_are

from repro.filters import best_in_form, emvf, genie, intermittent_kf, nahi, omvf, sun
from repro.filters.families import second_moments
from repro.models.sparse import dense
from repro.network.packet_delays import mean_weights
from repro.parameters.settings import ExtendedMinimumVariance, MinimumVariance
from repro.runner import run
from repro.studies import linear_delays, wsn_tracking
from repro.studies.wsn_tracking import position_error
from tests.conftest import points, small_log

STEPS = 12
OMVF_SETTINGS = MinimumVariance.checked({"alpha_rule": "sum to one", "qbar_sign": 1}, "test")
SETTINGS = {"omvf": OMVF_SETTINGS.plain()}  # the others have none


def linear_model(bound=2, p=0.5, sine_period=2):
    parameters = points()["linear_delays"]["arrival=0.5"].parameters
    changed = {"sine_period": sine_period, "arrival_probability": p, "packet_bound": bound}
    return linear_delays.STUDY.model(parameters.model_copy(update=changed))


def measurement_moments(model):
    """E[z(i) z(j)] and E[x(K) z(j)] for steps 0 ... K, written out without any recursion over k."""
    n, c = len(model.initial_mean), model.measurement_row
    transitions = [model.transition_matrix(k) for k in range(STEPS)]
    # x(k) = sum of the maps of [x(0), w(0), ..., w(K-1)]; each block of columns has its covariance.
    maps = np.zeros((STEPS + 1, n, n * (STEPS + 1)))
    for k in range(STEPS + 1):
        for source in range(k + 1):
            product = np.eye(n)
            for a in transitions[source:k]:
                product = a @ product
            maps[k][:, n * source : n * (source + 1)] = product
    blocks = [model.initial_covariance] + [model.process_covariance] * STEPS
    noise = np.zeros((n * (STEPS + 1),) * 2)
    for i, block in enumerate(blocks):
        noise[n * i : n * (i + 1), n * i : n * (i + 1)] = block
    rows = np.array([c @ m for m in maps])
    zz = rows @ noise @ rows.T + model.measurement_variance * np.eye(STEPS + 1)
    return zz, maps[-1] @ noise @ rows.T


def batch_lmmse(model, y):
    """Linear MMSE estimate of x(K) from y(1) ... y(K) by their full covariance."""
    weights = mean_weights(model.network.arrival_probability, model.network.bound)
    zz, xz = measurement_moments(model)
    take = np.zeros((STEPS, STEPS + 1))  # E y = take z
    power = np.zeros(STEPS)  # E y^2
    for k in range(1, STEPS + 1):
        for i, weight in enumerate(weights):
            if k - i >= 0:
                take[k - 1, k - i] = weight
                power[k - 1] += weight * zz[k - i, k - i]
    yy = take @ zz @ take.T
    np.fill_diagonal(yy, power)  # independent delays: only the diagonal is not a product of means
    return xz @ take.T @ np.linalg.solve(yy, y)


def filtered(module, model, channels, settings=OMVF_SETTINGS):
    """Estimate of a filter after all of y (STEPS,) given as its channel, and its last state."""
    filter_ = module.build(model, settings)
    state = filter_.init(range(1))
    for k in range(1, STEPS + 1):
        seen = type("Seen", (), {name: values[[k - 1]] for name, values in channels.items()})
        state = filter_.step(state, k, seen)
    return filter_.mean(state)[0], filter_.variance(state)


@pytest.mark.parametrize("bound", [1, 2, 3])
@pytest.mark.parametrize("sine_period", [2, 7])
def test_lmmse_recursion_is_the_batch_computation(bound, sine_period):
    model = linear_model(bound, 0.4, sine_period)
    y = np.random.default_rng(bound).normal(size=STEPS) * 3
    estimate, _ = filtered(sun, model, {"received": y})
    np.testing.assert_allclose(estimate, batch_lmmse(model, y), rtol=1e-9)


def test_nahi_is_the_lmmse_filter_of_its_channel():
    p, model = 0.6, linear_model(2, 0.6, 7)
    y = np.random.default_rng(8).normal(size=STEPS) * 3
    zz, xz = measurement_moments(model)
    signal = zz - model.measurement_variance * np.eye(STEPS + 1)
    yy = p**2 * signal[1:, 1:]
    np.fill_diagonal(yy, p * np.diagonal(signal)[1:])
    yy += model.measurement_variance * np.eye(STEPS)
    expected = p * xz[:, 1:] @ np.linalg.solve(yy, y)
    estimate, _ = filtered(nahi, model, {"uncertain": y})
    np.testing.assert_allclose(estimate, expected, rtol=1e-9)


def test_every_linear_filter_is_the_kalman_filter_without_losses():
    model = linear_model(2, 1.0)
    y = np.random.default_rng(1).normal(size=STEPS) * 3
    channels = {"received": y, "uncertain": y, "arrival": np.ones(STEPS), "delay": np.zeros(STEPS)}
    expected, variance = filtered(intermittent_kf, model, channels)
    np.testing.assert_allclose(expected, batch_lmmse(model, y), rtol=1e-9)
    for module in (omvf, sun, nahi, genie, best_in_form):
        estimate, claimed = filtered(module, model, channels)
        np.testing.assert_allclose(estimate, expected, rtol=1e-9)
        np.testing.assert_allclose(np.squeeze(claimed), variance[0], rtol=1e-9)


def test_omvf_covariance_without_losses_is_the_riccati_solution():
    model = linear_model(2, 1.0)
    a, c = model.transition_matrix(0), model.measurement_row[:, None]
    predicted = solve_discrete_are(a.T, c, model.process_covariance, [[model.measurement_variance]])
    gain = predicted @ c / (c.T @ predicted @ c + model.measurement_variance)
    filter_ = omvf.build(model, OMVF_SETTINGS)
    state = filter_.init(range(1))
    for k in range(1, 400):
        state = filter_.step(state, k, type("Seen", (), {"received": np.zeros(1)}))
    np.testing.assert_allclose(state.covariance, predicted - gain @ c.T @ predicted, rtol=1e-8)


def true_error(model, gains):
    """Exact mean square error at the last step of a filter of form (6) with the given (F, K)."""
    moment = second_moments.initial(model, model.initial_second_moment)
    for k, (transfer, gain) in enumerate(gains):
        moment = second_moments.predict(model, moment, k)
        moment = second_moments.update(model, moment, transfer, gain)
    return second_moments.mean_square_error(moment, 2)


def omvf_gains(model, steps):
    """F(k) and K(k) of the OMVF: its response to unit estimates and to a unit measurement."""
    filter_ = omvf.build(model, OMVF_SETTINGS)
    state, gains = filter_.init(range(3)), []
    seen = type("Seen", (), {"received": np.array([0.0, 0.0, 1.0])})
    for k in range(1, steps + 1):
        state = filter_.step(state._replace(estimate=np.eye(3, 2)), k, seen)
        gains.append((state.estimate[:2].T, state.estimate[2]))
    return gains


@pytest.mark.parametrize("p", [0.1, 0.5, 0.9])
@pytest.mark.parametrize("bound", [1, 2, 3])
def test_true_errors_are_ordered(p, bound):
    """OMVF >= best filter of its form >= exact LMMSE, in every component and without sampling."""
    model, steps = linear_model(bound, p), 60
    errors = {"omvf": np.diagonal(true_error(model, omvf_gains(model, steps)))}
    for module in (best_in_form, sun):
        filter_ = module.build(model, OMVF_SETTINGS)
        state = filter_.init(range(1))
        for k in range(1, steps + 1):
            state = filter_.step(state, k, type("Seen", (), {"received": np.zeros(1)}))
        errors[module] = filter_.variance(state)
    assert (errors["omvf"] >= errors[best_in_form] - 1e-12).all()
    assert (errors[best_in_form] >= errors[sun] - 1e-12).all()
    assert (errors["omvf"] > errors[sun] + 1e-4).all()


def test_exact_second_moments_are_what_sampling_finds():
    parameters = points()["linear_delays"]["arrival=0.5"].parameters
    log = small_log("linear_delays", "arrival=0.5", trials=4000, steps=20)
    model = linear_delays.STUDY.model(parameters)
    x0 = np.array(parameters.true_initial_state)
    started = model._replace(initial_second_moment=np.outer(x0, x0))
    exact_of_omvf = np.diagonal(true_error(started, omvf_gains(model, 20)))
    for name in ("omvf", "best_in_form"):
        _, runs = run(log, name, SETTINGS.get(name, {}))
        squared = runs.error[:, -1] ** 2
        exact = exact_of_omvf if name == "omvf" else runs.claimed[-1]
        error = squared.std(axis=0) / np.sqrt(len(squared))
        assert (np.abs(squared.mean(axis=0) - exact) < 4 * error + 1e-3).all()


def test_genie_is_below_every_filter_and_knows_its_own_error():
    log = small_log("linear_delays", "arrival=0.5", trials=3000, steps=20)
    _, informed = run(log, "genie", {})
    squared = (informed.error[:, 10:] ** 2).mean(axis=1)
    spread = squared.std(axis=0) / np.sqrt(len(squared))
    claimed = informed.claimed[:, 10:].mean(axis=(0, 1))
    assert (np.abs(squared.mean(axis=0) - claimed) < 4 * spread).all()
    for name in ("omvf", "sun", "best_in_form", "intermittent_kf"):
        _, other = run(log, name, SETTINGS.get(name, {}))
        difference = (other.error[:, 10:] ** 2).mean(axis=1) - squared
        assert (difference.mean(axis=0) > 0).all()


# ---- tracking ----


def tracking(point, names, trials=40, **changes):
    settings = points()["wsn_tracking"][point].filters
    log = small_log("wsn_tracking", point, trials, steps=65)
    runs = [run(log, name, settings.get(name, {}) | changes)[1] for name in names]
    return [position_error(entry) for entry in runs]


def test_without_losses_emvf_is_the_ekf_for_every_bound():
    ekf, first = tracking("n1-arrival=1", ["ekf", "emvf"])
    (second,) = tracking("n2-arrival=1", ["emvf"])
    kept = (ekf < 10).all(axis=1)
    assert kept.mean() > 0.5
    np.testing.assert_allclose(first[kept], ekf[kept], atol=1e-6)
    np.testing.assert_allclose(second[kept], ekf[kept], atol=1e-6)


def emvf_estimate(initial_second_moment, shift):
    """EMVF on one run whose coordinates have another origin; packets 10 and 20 come late."""
    point = points()["wsn_tracking"]["n2-arrival=0.9"]
    parameters = point.parameters
    start = np.array(parameters.initial_estimate) + np.array([*shift, 0, 0, 0])
    log = small_log("wsn_tracking", "n2-arrival=0.9", 3, steps=30)
    values = {topic: array.copy() for topic, array in log.values.items()}
    values["/truth"][:, :, :2] += shift
    values["/field"] += np.tile(shift, parameters.sensors)
    parameters = log.parameters.model_copy(update={"initial_estimate": tuple(start.tolist())})
    moved = log._replace(values=values, parameters=parameters)
    settings = point.filters["emvf"] | {"initial_second_moment": initial_second_moment}
    return run(moved, "emvf", settings)[1].error


def test_emvf_takes_dense_jacobians():
    """As a model of a reader's own may give them."""
    log = small_log("wsn_tracking", "n2-arrival=0.9", 3, steps=30)
    study, point = wsn_tracking.STUDY, points()["wsn_tracking"]["n2-arrival=0.9"]
    model = study.model(log.parameters)

    def transition_jacobian(x, k):
        return dense(model.transition_jacobian(x, k), (3,), 5)

    def measurement_jacobian(x, sensor):
        return dense(model.measurement_jacobian(x, sensor), (3,), 5)

    with_arrays = model._replace(
        transition_jacobian=transition_jacobian, measurement_jacobian=measurement_jacobian
    )
    settings, estimates = ExtendedMinimumVariance.checked(point.filters["emvf"], "test"), []
    for given in (model, with_arrays):
        filter_, channels = emvf.build(given, settings), study.channels(log, slice(0, 3))
        state = filter_.init(range(3))
        for k in range(1, 31):
            seen = type("Seen", (), channels.at(k, filter_.predicted(state, k)))
            state = filter_.step(state, k, seen)
        estimates.append(filter_.mean(state))
    np.testing.assert_array_equal(*estimates)


def test_matched_second_moment_does_not_depend_on_the_origin():
    """The printed terms in S do: the second moment of H x is not the spread of h."""
    here, there = (emvf_estimate("matched", np.array(s)) for s in ([0.0, 0.0], [200.0, -300.0]))
    np.testing.assert_allclose(here, there, atol=1e-6)
    here, there = (emvf_estimate("theorem_2", np.array(s)) for s in ([0.0, 0.0], [200.0, -300.0]))
    assert np.abs(here - there).max() > 0.01


def test_realised_weights_of_the_packet_itself_beat_the_means():
    """With the indicators of its own packet, the EMVF compares a late packet with its own range."""
    (means,) = tracking("n2-arrival=0.9", ["emvf"])
    (realised,) = tracking("n2-arrival=0.9", ["emvf_realised"], indicator_of="k+1")
    assert np.median(realised[:, 1:].max(axis=1)) < 0.2 * np.median(means[:, 1:].max(axis=1))


def test_printed_covariances_with_a_wrong_packet_are_trusted_too_much():
    """The printed S(0) = P(0) omits m_0 m_0': late packets then count as if they were on time."""
    theorem, printed = (
        tracking("n2-arrival=0.9", ["emvf"], initial_second_moment=value)[0]
        for value in ("theorem_2", "P0")
    )
    assert np.median(printed.max(axis=1)) > 3 * np.median(theorem.max(axis=1))


def test_spread_of_ranges_is_a_variance():
    weights, ranges = np.array([[0.5], [0.3], [0.2]]), np.array([[3.0], [4.0], [10.0]])
    mean = (weights * ranges).sum()
    expected = (weights * (ranges - mean) ** 2).sum()
    assert emvf.spread_of_ranges(weights, ranges)[0] == pytest.approx(expected)
