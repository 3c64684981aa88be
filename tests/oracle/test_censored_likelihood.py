"""[censored_network Propositions 1 and 2] against integrals and the printed formulas."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.stats import norm

from repro.filters.families import censored_likelihood
from repro.models.mixture_noise import MixtureNoise
from repro.network.censoring import ABOVE, BELOW, EXACT, INSIDE, Censoring, censored
from repro.studies.deadband import STUDY
from tests.conftest import points

STUDIES = ("deadband", "saturation")
CODES = {"deadband": (INSIDE,), "saturation": (BELOW, ABOVE)}


def known(name, **changes):
    return STUDY.model(points()[name]["base"].parameters)._replace(**changes)


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
        likelihood = censored_likelihood.build(model)
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
    step = censored_likelihood.STEP
    nodes = np.arange(weakest, strongest + 2 * step, step)
    strength = np.random.default_rng(0).uniform(weakest, strongest, 20000)
    for code in CODES[name]:
        table = censored_likelihood.Table(*censored_likelihood.log_probability(model, code, nodes))
        exact, _ = censored_likelihood.log_probability(model, code, strength)
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
        value, slope = censored_likelihood.log_probability(model, code, strength)
        np.testing.assert_allclose(np.exp(value), naive, rtol=1e-10, atol=1e-15)
        shifted = [
            censored_likelihood.log_probability(model, code, strength + h)[0] for h in (1e-5, -1e-5)
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
    """[censored_network (14), (21)] as printed, without logs; x (..., 2) of one target."""
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
    ours = censored_likelihood.build(model)(x, seen, 1)
    assert len(np.unique(codes)) == 1 + len(CODES[name])
    for t in range(6):
        for i in range(3):
            of_target = SimpleNamespace(**{key: value[t, i] for key, value in vars(seen).items()})
            wanted = group_likelihood(model, of_target, x[t, i, :2].T)
            np.testing.assert_allclose(np.exp(ours[t, i]), wanted, rtol=1e-8)


@pytest.mark.parametrize(
    "censoring", [Censoring("saturation", -1e9, 1e9, 0.0), Censoring("dead band", 3.0, 3.0, 3.0)]
)
def test_without_censoring_nothing_is_compensated(censoring):
    """[censored_network Remark 3]: very large thresholds in (5), or equal ones in (4)."""
    model = known("deadband", censoring=censoring)
    rng = np.random.default_rng(2)
    readings, codes = censored(rng.uniform(-30, 10, (4, 3, 3)), censoring)
    seen = SimpleNamespace(
        received=readings, code=codes, group_probability=np.broadcast_to([0.2, 0.8], (4, 3, 2))
    )
    x = rng.uniform(20, 60, (4, 3, 3, 100))
    likelihoods = [censored_likelihood.build(model, flag)(x, seen, 1) for flag in (True, False)]
    np.testing.assert_array_equal(*likelihoods)


def test_a_certain_group_is_the_only_one():
    model, rng = known("saturation"), np.random.default_rng(3)
    x = rng.uniform(20, 60, (1, 1, 3, 50))
    received, code = censored(rng.uniform(-25, 0, (1, 1, 3)), model.censoring)
    seen = SimpleNamespace(received=received, code=code, group_probability=np.array([[[1.0, 0.0]]]))
    both = censored_likelihood.build(model)(x, seen, 1)
    alone = model._replace(sensors=model.sensors[:1])
    seen.group_probability = np.ones((1, 1, 1))
    np.testing.assert_allclose(both, censored_likelihood.build(alone)(x, seen, 1), rtol=1e-13)
