"""The filters of censored_network against exact filters."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.stats import norm

from repro.filters.families import protocol_particles
from repro.models.coupled_targets import SignalStrength
from repro.models.mixture_noise import MixtureNoise
from repro.network.censoring import EXACT, censored
from repro.parameters.settings import ProtocolParticles
from repro.runner import run
from repro.streams import Streams
from repro.studies.deadband import STUDY
from repro.studies.families.censored_network import squared_distance
from tests.conftest import small_log
from tests.oracle.test_censored_likelihood import STUDIES, group_likelihood, known

SETTINGS = ProtocolParticles(particles=1000, resampling="systematic", coupling_drawn_per="particle")


def with_particles(particles):
    return SETTINGS.model_copy(update={"particles": particles})


def streams(trials, role="filter:test"):
    return Streams(5, "oracle", role, range(trials))


@pytest.mark.parametrize("change", ["rate", "strength"])
def test_without_coupling_mapf_is_mapf_nc(change):
    log = small_log("deadband", "base", trials=2, steps=5)
    model = STUDY.model(log.parameters)
    model = (
        model._replace(coupling_rate=0.0)
        if change == "rate"
        else model._replace(coupling=np.zeros((3, 3)))
    )
    loop = STUDY.channels(log, slice(None))
    estimates = []
    for coupled in (True, False):
        filter_ = protocol_particles.auxiliary(model, SETTINGS, coupled=coupled)
        state = filter_.init(streams(2))
        for k in range(1, 6):
            state = filter_.step(state, k, SimpleNamespace(**loop.at(k, None)))
        estimates.append(filter_.mean(state))
    np.testing.assert_array_equal(*estimates)


def test_prior_mean_error():
    """The prior is centred on the truth: at k = 0 the error is that of a mean of 1000 draws."""
    log = small_log("deadband", "base", trials=300, steps=1)
    _, runs = run(log, "dead_reckoning", SETTINGS.plain())
    rms = np.sqrt(squared_distance(runs)[:, 0].mean())
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
    for build in (protocol_particles.auxiliary, protocol_particles.bootstrap):
        medians = []
        for size in sizes:
            filter_ = build(model, with_particles(size))
            state = filter_.init(streams(REDUCED_TRIALS))
            for k in range(1, REDUCED_STEPS + 1):
                state = filter_.step(state, k, data[k])
            gap = np.linalg.norm(filter_.mean(state)[:, :2] - exact, axis=1)
            medians.append(np.median(gap))
        slope = np.polyfit(np.log(sizes), np.log(medians), 1)[0]
        assert -0.65 < slope < -0.35, (build.__name__, medians)
        assert medians[-1] < 0.1, (build.__name__, medians)


@pytest.mark.parametrize("build", [protocol_particles.auxiliary, protocol_particles.bootstrap])
def test_linear_gaussian_limit_is_the_kalman_filter(build):
    """One sensor, so far away that the strength is linear in the position along its direction."""
    trials, size, steps, far, speed = 100, 2000, 12, 1e6, 1.5
    deviation, noise, r = np.array([2.0, 0.5]), np.array([0.3, 0.2]), 1.5**2
    exponent = far * np.log(10) / 10  # a metre is a decibel
    model = known(
        "deadband",
        initial_mean=np.zeros(3),
        initial_deviation=np.array([*deviation, 0.0]),
        speed=np.array([speed]),
        turn_rate=0.0,
        process_deviation=np.array([*noise, 0.0]),
        coupling=np.zeros((1, 1)),
        sensors=np.array([[[far, 0.0]]]),
        strength=SignalStrength(0.0, exponent, far),
        noise=MixtureNoise(0.5, np.sqrt(r), np.sqrt(r)),
    )
    rng = np.random.default_rng(4)
    filter_ = build(model, with_particles(size))
    truth = deviation * rng.standard_normal((trials, 2))
    mean, variance, forward = np.zeros((trials, 2)), deviation**2, np.array([speed, 0.0])
    state, gaps = filter_.init(streams(trials)), []
    for k in range(1, steps + 1):
        truth = truth + forward + noise * rng.standard_normal((trials, 2))
        y = truth[:, 0] + np.sqrt(r) * rng.standard_normal(trials)
        mean, variance = mean + forward, variance + noise**2
        gain = variance[0] / (variance[0] + r)
        mean[:, 0] += gain * (y - mean[:, 0])
        variance = variance * [1 - gain, 1.0]
        seen = SimpleNamespace(
            received=y[:, None, None],
            code=np.full((trials, 1, 1), EXACT),
            group_probability=np.ones((trials, 1, 1)),
        )
        state = filter_.step(state, k, seen)
        gaps.append((filter_.mean(state)[:, :2] - mean) / np.sqrt(variance))
    gaps = np.array(gaps)
    rms = np.sqrt((gaps**2).mean())
    assert rms < 4 / np.sqrt(size)  # in posterior standard deviations: a few effective draws less
    assert np.abs(gaps.mean(axis=(0, 1))).max() < 4 * rms / np.sqrt(trials)  # no bias


def test_mapf_and_mpf_have_one_limit():
    """Their estimates differ by Monte Carlo noise only, which falls as the particles grow."""
    log = small_log("saturation", "base", trials=4, steps=8)
    gaps = []
    for size in (500, 4500):
        first, second = (
            run(log, name, with_particles(size).plain())[0] for name in ("mapf", "mpf")
        )
        gaps.append(np.sqrt(((first - second)[:, 1:] ** 2).mean()))
    assert gaps[1] < 0.6 * gaps[0]  # a third is expected
