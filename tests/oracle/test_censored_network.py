"""The filters of the censored-network paper against exact computations."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import norm

from repro.filters import _censored_likelihood, _particles, _protocol_particles
from repro.models.mixture_noise import MixtureNoise
from repro.network.censoring import ABOVE, BELOW, EXACT, INSIDE, Censoring, censored
from repro.run import run
from repro.streams import Streams
from repro.studies import _censored_network as study
from tests.conftest import points, small_log

STUDIES = ("deadband", "saturation")
CODES = {"deadband": (INSIDE,), "saturation": (BELOW, ABOVE)}
SETTINGS = {"particles": 1000, "resampling": "systematic", "coupling_drawn_per": "particle"}


def known(name, **changes):
    return study.model(points()[name]["base"].parameters)._replace(**changes)


def streams(trials, role="filter:test"):
    return Streams(5, "oracle", role, range(trials))


def cumulative(t):
    """F of the noise, as printed."""
    return 0.8 * norm.cdf(t, scale=1) + 0.2 * norm.cdf(t, scale=6)


def density(t):
    return 0.8 * norm.pdf(t, scale=1) + 0.2 * norm.pdf(t, scale=6)


def one_reading(log_likelihood, position, code, value):
    """Likelihood of a network with a single sensor, for a particle at `position`."""
    x = np.array([*position, 0.0]).reshape(1, 1, 3, 1)
    seen = SimpleNamespace(
        received=np.full((1, 1, 1), value),
        code=np.full((1, 1, 1), code),
        group_probability=np.ones((1, 1, 1)),
    )
    return np.exp(log_likelihood(x, seen, 1)[0, 0, 0])


@pytest.mark.parametrize("name", STUDIES)
@pytest.mark.parametrize("position", [(16.0, 14.0), (43.0, 41.0), (61.0, 47.5), (33.0, 60.0)])
def test_likelihoods_integrate_to_one(name, position):
    for sensor in np.array(known(name).sensors).reshape(-1, 2):
        model = known(name, sensors=sensor.reshape(1, 1, 2))
        low, high = model.censoring.lower, model.censoring.upper
        pieces = [(low, high)] if name == "saturation" else [(-90, low), (high, 90)]
        mean = 10 - 20 * np.log10(np.hypot(*(np.array(position) - sensor)))
        likelihood = _censored_likelihood.build(model)
        total = sum(one_reading(likelihood, position, code, 0.0) for code in CODES[name])
        for left, right in pieces:
            near = [mean] if left < mean < right else None
            total += quad(
                lambda y, likelihood=likelihood: one_reading(likelihood, position, EXACT, y),
                left,
                right,
                points=near,
                limit=200,
            )[0]
        assert total == pytest.approx(1.0, abs=1e-7)


@pytest.mark.parametrize("name", STUDIES)
def test_tables_are_as_good_as_the_functions(name):
    model = known(name)
    weakest, strongest = model.strength.range()
    step = _censored_likelihood.STEP
    nodes = np.arange(weakest, strongest + 2 * step, step)
    strength = np.random.default_rng(0).uniform(weakest, strongest, 20000)
    for code in CODES[name]:
        table = _censored_likelihood.Table(
            *_censored_likelihood.log_probability(model, code, nodes)
        )
        exact, _ = _censored_likelihood.log_probability(model, code, strength)
        np.testing.assert_allclose(table((strength - weakest) / step), exact, rtol=1e-12, atol=1e-8)


def test_censored_probabilities_as_printed():
    strength = np.linspace(-40, 30, 141)  # where the naive differences keep their digits
    low, high = -10 - strength, 10 - strength
    saturation, deadband = known("saturation"), known("deadband")
    saturation = saturation._replace(censoring=deadband.censoring._replace(kind="saturation"))
    for model, code, naive in (
        (deadband, INSIDE, cumulative(high) - cumulative(low)),
        (saturation, BELOW, cumulative(low)),
        (saturation, ABOVE, cumulative(-high)),
    ):
        value, slope = _censored_likelihood.log_probability(model, code, strength)
        np.testing.assert_allclose(np.exp(value), naive, rtol=1e-10, atol=1e-15)
        shifted = [
            _censored_likelihood.log_probability(model, code, strength + h)[0]
            for h in (1e-5, -1e-5)
        ]
        np.testing.assert_allclose(slope, (shifted[0] - shifted[1]) / 2e-5, rtol=1e-5, atol=1e-8)


def test_far_tails_keep_their_digits():
    noise = MixtureNoise(0.2, 1.0, 6.0)
    assert noise.log_between(np.array(110.0), np.array(130.0)) == pytest.approx(
        noise.log_between(np.array(-130.0), np.array(-110.0)), rel=1e-12
    )
    assert noise.log_between(np.array(110.0), np.array(130.0)) == pytest.approx(
        np.log(0.2) + norm.logsf(110 / 6), abs=1e-6
    )
    assert noise.log_density(np.array([200.0]))[0] == pytest.approx(
        np.log(0.2) + norm.logpdf(200, scale=6), rel=1e-12
    )


def group_likelihood(model, seen, x):
    """(14), (21) as printed, without logs: for positions x (..., 2) of one target."""
    low, high = model.censoring.lower, model.censoring.upper
    total = 0.0
    for p, group in zip(seen.group_probability, model.sensors, strict=True):
        product = 1.0
        for sensor, value, code in zip(group, seen.received, seen.code, strict=True):
            h = 10 - 20 * np.log10(np.hypot(x[..., 0] - sensor[0], x[..., 1] - sensor[1]))
            product = (
                product
                * {
                    EXACT: lambda h=h, value=value: density(value - h),
                    INSIDE: lambda h=h: cumulative(high - h) - cumulative(low - h),
                    BELOW: lambda h=h: cumulative(low - h),
                    ABOVE: lambda h=h: cumulative(h - high),  # the noise is symmetric
                }[code]()
            )
        total = total + p * product
    return total


@pytest.mark.parametrize("name", STUDIES)
def test_likelihood_of_both_groups_as_printed(name):
    model, rng = known(name), np.random.default_rng(1)
    x = rng.uniform(20, 60, (6, 3, 3, 40))
    readings, codes = censored(rng.uniform(-25, 15, (6, 3, 3)), model.censoring)
    seen = SimpleNamespace(
        received=readings, code=codes, group_probability=np.broadcast_to([0.2, 0.8], (6, 3, 2))
    )
    found = _censored_likelihood.build(model)(x, seen, 1)
    assert len(np.unique(codes)) == 1 + len(CODES[name])
    for t in range(6):
        for i in range(3):
            of_target = SimpleNamespace(**{key: value[t, i] for key, value in vars(seen).items()})
            wanted = group_likelihood(model, of_target, x[t, i, :2].T)
            np.testing.assert_allclose(np.exp(found[t, i]), wanted, rtol=1e-8)


@pytest.mark.parametrize(
    "censoring", [Censoring("saturation", -1e9, 1e9, 0.0), Censoring("dead band", 3.0, 3.0, 3.0)]
)
def test_without_censoring_nothing_is_compensated(censoring):
    """Remark 3: thresholds at infinity in (5), or equal ones in (4)."""
    model = known("deadband", censoring=censoring)
    rng = np.random.default_rng(2)
    readings, codes = censored(rng.uniform(-30, 10, (4, 3, 3)), censoring)
    seen = SimpleNamespace(
        received=readings, code=codes, group_probability=np.broadcast_to([0.2, 0.8], (4, 3, 2))
    )
    x = rng.uniform(20, 60, (4, 3, 3, 100))
    likelihoods = [_censored_likelihood.build(model, flag)(x, seen, 1) for flag in (True, False)]
    np.testing.assert_array_equal(*likelihoods)


def test_a_certain_group_is_the_only_one():
    model, rng = known("saturation"), np.random.default_rng(3)
    x = rng.uniform(20, 60, (1, 1, 3, 50))
    received, code = censored(rng.uniform(-25, 0, (1, 1, 3)), model.censoring)
    seen = SimpleNamespace(received=received, code=code, group_probability=np.array([[[1.0, 0.0]]]))
    both = _censored_likelihood.build(model)(x, seen, 1)
    alone = model._replace(sensors=model.sensors[:1])
    seen.group_probability = np.ones((1, 1, 1))
    np.testing.assert_allclose(both, _censored_likelihood.build(alone)(x, seen, 1), rtol=1e-13)


@pytest.mark.parametrize("change", ["rate", "strength"])
def test_without_coupling_mapf_is_mapf_nc(change):
    log = small_log("deadband", "base", trials=2, steps=5)
    model = study.model(log.parameters)
    model = (
        model._replace(coupling_rate=0.0)
        if change == "rate"
        else model._replace(coupling=np.zeros((3, 3)))
    )
    loop = study.channels(log, slice(None), log.parameters)
    estimates = []
    for coupled in (True, False):
        filter_ = _protocol_particles.auxiliary(model, SETTINGS, coupled=coupled)
        state = filter_.init(streams(2))
        for k in range(1, 6):
            state = filter_.step(state, k, SimpleNamespace(**loop.at(k, None)))
        estimates.append(filter_.mean(state))
    np.testing.assert_array_equal(*estimates)


def test_prior_mean_error():
    """The prior is centred on the truth: at k = 0 the error is that of a mean of 1000 draws."""
    log = small_log("deadband", "base", trials=300, steps=1)
    _, runs = run(log, "dead_reckoning", SETTINGS)
    rms = np.sqrt(study.squared_distance(runs)[:, 0].mean())
    assert rms == pytest.approx(np.sqrt(18 / 1000), rel=4 * 0.5 / np.sqrt(900))


# One target of known heading that no other disturbs, and larger steps: two unknowns.
REDUCED_STEPS, REDUCED_TRIALS, NOISE, PRIOR = 5, 40, 0.6, 2.0
START = np.array([38.0, 46.0, 0.9])


def reduced(name):
    return known(
        name,
        initial_mean=START,
        initial_deviation=np.array([PRIOR, PRIOR, 0.0]),
        speed=np.ones(1),
        process_deviation=np.array([NOISE, NOISE, 0.0]),
        coupling=np.zeros((1, 1)),
        coupling_rate=0.0,
    )


def reduced_data(model):
    """Received values and codes of each trial and step, from a truth of the reduced problem."""
    rng = np.random.default_rng(8)
    trials, steps = REDUCED_TRIALS, REDUCED_STEPS
    truth = START[:2] + PRIOR * rng.standard_normal((trials, 2))
    data = [None]
    for k in range(1, steps + 1):
        truth = truth + displacement(model, k) + NOISE * rng.standard_normal((trials, 2))
        h = 10 - 20 * np.log10(np.linalg.norm(truth[:, None, None] - model.sensors, axis=-1))
        glint = rng.random(h.shape) < 0.2
        readings, codes = censored(
            h + np.where(glint, 6, 1) * rng.standard_normal(h.shape), model.censoring
        )
        group = (rng.random(trials) > 0.2).astype(int)
        pick = (np.arange(trials), group)
        data.append(
            SimpleNamespace(
                received=readings[pick][:, None],
                code=codes[pick][:, None],
                group_probability=np.broadcast_to([0.2, 0.8], (trials, 1, 2)),
            )
        )
    return data


def displacement(model, k):
    phi = START[2] + model.turn_rate * (k - 1)
    return np.array([np.cos(phi), np.sin(phi)])


def grid_means(model, data, half=9.0, step=0.25):
    """Posterior means (trials, 2) at the last step by a grid that moves with the target."""
    axis = np.arange(-half, half + step / 2, step)
    spread = norm.pdf(axis[:, None] - axis, scale=NOISE) * step
    means = np.empty((REDUCED_TRIALS, 2))
    for t in range(REDUCED_TRIALS):
        centre = START[:2].copy()
        prior = norm.pdf(axis, scale=PRIOR)
        belief = prior[:, None] * prior
        for k in range(1, REDUCED_STEPS + 1):
            centre += displacement(model, k)
            belief = spread @ belief @ spread.T
            x = centre + np.stack(np.meshgrid(axis, axis, indexing="ij"), axis=-1)
            of_trial = SimpleNamespace(**{key: v[t, 0] for key, v in vars(data[k]).items()})
            belief *= group_likelihood(model, of_trial, x)
            belief /= belief.sum()
        means[t] = centre + np.array([belief.sum(axis=1) @ axis, belief.sum(axis=0) @ axis])
    return means


@pytest.mark.parametrize("name", STUDIES)
def test_filters_approach_the_grid_filter(name):
    model = reduced(name)
    data = reduced_data(model)
    assert len({*np.unique(np.concatenate([d.code for d in data[1:]]))}) == 2
    exact = grid_means(model, data)
    sizes = (250, 1000, 4000)
    for build in (_protocol_particles.auxiliary, _protocol_particles.bootstrap):
        medians = []
        for size in sizes:
            filter_ = build(model, SETTINGS | {"particles": size})
            state = filter_.init(streams(REDUCED_TRIALS))
            for k in range(1, REDUCED_STEPS + 1):
                state = filter_.step(state, k, data[k])
            gap = np.linalg.norm(filter_.mean(state)[:, :2] - exact, axis=1)
            medians.append(np.median(gap))
        slope = np.polyfit(np.log(sizes), np.log(medians), 1)[0]
        assert -0.65 < slope < -0.35, (build.__name__, medians)
        assert medians[-1] < 0.1, (build.__name__, medians)


@pytest.mark.parametrize("kernel", ["auxiliary", "bootstrap"])
def test_linear_gaussian_limit_is_the_kalman_filter(kernel):
    trials, size, steps = 100, 2000, 12
    transition, noise, r = np.array([[1.0, 1.0], [0.0, 0.95]]), np.array([0.3, 0.2]), 1.5**2
    mean0, root0 = np.array([0.0, 1.0]), np.diag([2.0, 0.5])

    def drift(x, k):
        return transition @ x

    def disturb(moved, cloud, k):
        return moved + noise[:, None] * _particles.standard_normal(cloud.streams, 2, size)

    def log_likelihood(x, y, k):
        return -0.5 * (y[:, None] - x[:, 0]) ** 2 / r

    def initial(drawn):
        return _particles.gaussian(drawn, mean0, root0, size)

    if kernel == "auxiliary":
        filter_ = _particles.auxiliary(initial, drift, disturb, log_likelihood)
    else:
        filter_ = _particles.bootstrap(
            initial, lambda x, cloud, k: disturb(drift(x, k), cloud, k), log_likelihood
        )
    rng = np.random.default_rng(4)
    truth = mean0 + rng.standard_normal((trials, 2)) @ root0
    mean, covariance = np.tile(mean0, (trials, 1)), root0 @ root0
    state, gaps = filter_.init(streams(trials)), []
    for k in range(1, steps + 1):
        truth = truth @ transition.T + noise * rng.standard_normal((trials, 2))
        y = truth[:, 0] + np.sqrt(r) * rng.standard_normal(trials)
        mean = mean @ transition.T
        covariance = transition @ covariance @ transition.T + np.diag(noise**2)
        gain = covariance[:, 0] / (covariance[0, 0] + r)
        mean = mean + (y - mean[:, 0])[:, None] * gain
        covariance = covariance - np.outer(gain, covariance[0])
        state = filter_.step(state, k, y)
        gaps.append((filter_.mean(state) - mean) / np.sqrt(np.diag(covariance)))
    gaps = np.array(gaps)
    rms = np.sqrt((gaps**2).mean())
    assert rms < 3 / np.sqrt(size)  # in posterior standard deviations: a few effective draws less
    assert np.abs(gaps.mean(axis=(0, 1))).max() < 4 * rms / np.sqrt(trials)  # no bias


def test_mapf_and_mpf_have_one_limit():
    """Their estimates differ by Monte Carlo noise only, which falls as the particles grow."""
    log = small_log("saturation", "base", trials=4, steps=8)
    gaps = []
    for size in (500, 4500):
        first, second = (
            run(log, name, SETTINGS | {"particles": size})[0] for name in ("mapf", "mpf")
        )
        gaps.append(np.sqrt(((first - second)[:, 1:] ** 2).mean()))
    assert gaps[1] < 0.6 * gaps[0]  # a third is expected
