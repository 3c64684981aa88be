"""The compiled bootstrap steps against the same in NumPy and SciPy."""

import numpy as np
import pytest
from scipy import stats
from scipy.special import logsumexp

from repro import plugins
from repro.filters.families import ross_eh
from repro.kernels import sensor_network_step
from repro.models import rss, ungm
from repro.models.sensor_network import ExponentialNoise, GaussianNoise
from repro.models.ungm import Growth
from repro.network.energy_harvesting import transmission_probability
from repro.network.saturation import Saturation, saturated
from repro.parameters.settings import Bootstrap
from repro.streams import Streams
from tests.conftest import small_log

RNG = np.random.default_rng(2)
COUNT = 301
GAUSSIAN = GaussianNoise(np.array([0.1, 0.2]), 0.001), Saturation(0.2, 30.0)
EXPONENTIAL = ExponentialNoise(2.0, 2), Saturation(0.5, 10.0)
NOISES = {"Gaussian": np.array([0.1, 0.2, 0.001]), "exponential": np.array([2.0, 2.0, 0.0])}


def log_likelihood(noise, i, z, levels, saturation, transmission):
    """Logarithm of the three terms of (15), of the shape of `levels`."""
    if isinstance(noise, GaussianNoise):
        channel = stats.norm(scale=np.sqrt(noise.channel_variance))
        total = stats.norm(scale=np.sqrt(noise.measurement_variances[i] + noise.channel_variance))
    else:
        channel, total = stats.expon(scale=noise.mean), stats.gamma(2, scale=noise.mean)
    gbar, limit = saturation
    shares = [transmission * (1 - gbar), transmission * gbar, 1 - transmission]
    terms = [
        total.logpdf(z - levels),
        total.logpdf(z - saturated(levels, limit)),
        np.broadcast_to(channel.logpdf(z), levels.shape),
    ]
    return logsumexp(np.stack(terms, axis=-1), axis=-1, b=shares)


def weights_of(logs):
    """Weights of each row, and whether nothing explains its measurement."""
    degenerate = np.isneginf(logs).all(axis=-1, keepdims=True)
    logs = np.where(degenerate, 0.0, logs)
    weights = np.exp(logs - logs.max(axis=-1, keepdims=True))
    return weights / weights.sum(axis=-1, keepdims=True), degenerate[..., 0]


@pytest.mark.parametrize("family", ["Gaussian", "exponential"])
@pytest.mark.parametrize("transmission", [0.4, 1.0])
@pytest.mark.parametrize("saturates", [True, False])
def test_weights(family, transmission, saturates):
    noise, saturation = GAUSSIAN if family == "Gaussian" else EXPONENTIAL
    limit = saturation.level
    network = transmission, saturation.probability if saturates else 0.0, limit
    # Usual measurements; at the limit; far from every level, and both together
    for z in ([limit, 0.8 * limit], [-limit, 4.0], [3 * limit, 0.1], [70 * limit, 90 * limit]):
        z = np.array(z)
        levels = RNG.uniform(0.5, 1.6, (2, COUNT)) * limit
        levels[0, ::2] *= -1.0 if family == "Gaussian" else 1.0
        weights = np.empty(COUNT)
        bad = sensor_network_step.weigh(levels, z, NOISES[family], network, True, weights)
        known = saturation if saturates else Saturation(0.0, limit)
        logs = [log_likelihood(noise, i, z[i], levels[i], known, transmission) for i in range(2)]
        wanted, degenerate = weights_of(np.sum(logs, axis=0))
        assert bad == degenerate
        np.testing.assert_allclose(weights, wanted, rtol=1e-9, atol=1e-90)


def test_linear_weights_underflow():
    levels, weights = np.zeros((2, COUNT)), np.empty(COUNT)
    arguments = levels, np.array([90.0, 0.0]), NOISES["Gaussian"], (1.0, 0.0, 30.0)
    assert sensor_network_step.weigh(*arguments, False, weights)
    assert not sensor_network_step.weigh(*arguments, True, weights)
    levels[0, 3] = 1.0  # nearer than the others
    assert not sensor_network_step.weigh(*arguments, True, weights)
    assert weights[3] == 1.0


class Seen:
    def __init__(self, received):
        self.received = received


def estimates(model, log, scheme):
    settings = Bootstrap(particles=150, resampling=scheme, weights="logarithmic")
    filter_ = ross_eh.build(model, settings, saturates=True, transmission="lemma1")
    state = filter_.init(Streams(log.seed, log.study, "filter:bootstrap", log.trials.tolist()))
    found = []
    for k in range(1, log.steps):
        state = filter_.step(state, k, Seen(log.values["/received"][:, k]))
        found.append(filter_.mean(state))
        sizes = filter_.diagnostics(state)["effective_sample_size"]
        assert np.all((sizes >= 1 - 1e-9) & (sizes <= 150 + 1e-9))
    return np.stack(found, axis=1)


def level(plant, x, i):
    """h^i(x) of either plant, from states (trials, n, particles)."""
    if isinstance(plant, Growth):
        return (x[:, 0] - plant.offsets[i]) ** 2 / 20
    distance = np.linalg.norm(x[:, ::2] - plant.sensors[i][:, None], axis=1)
    return plant.power - 10 * plant.exponent * np.log10(distance / plant.reference)


def moved(plant, x, k, streams):
    """x(k) from p(x(k)|x(k-1)) of either plant, states (trials, n, particles)."""
    if isinstance(plant, Growth):
        noise = ungm.gamma_noise(streams, plant.noise_scale, *x.shape[1:])
        return ungm.transition(x, k - 1) + noise
    return rss.move(x, streams.standard_normal(*x.shape[1:]), plant.time, plant.root)


def numpys(model, log):
    """Estimates of the same filter with independent draws."""
    transmission = transmission_probability(model.energy, model.steps, "lemma1")
    streams, rng = Streams(log.seed, log.study, "numpy", log.trials.tolist()), RNG
    x, weights, found = model.draw_prior(streams, 150), np.full((len(streams), 150), 1 / 150), []
    for k in range(1, log.steps):
        parents = [rng.choice(150, 150, p=w) for w in weights]
        x = np.stack([of_trial[:, p] for of_trial, p in zip(x, parents, strict=True)])
        x = moved(model.plant, x, k, streams)
        z = log.values["/received"][:, k]
        logs = [
            log_likelihood(
                model.noise,
                i,
                z[:, i, None],
                level(model.plant, x, i),
                model.saturation,
                transmission[k],
            )
            for i in range(model.sensors)
        ]
        weights, _ = weights_of(np.sum(logs, axis=0))
        found.append((x * weights[:, None]).sum(axis=2))
    return np.stack(found, axis=1)


@pytest.mark.parametrize("study", ["ungm", "rss_2d", "rss_3d"])
@pytest.mark.parametrize("scheme", ["systematic", "multinomial"])
def test_errors_are_those_of_numpy(study, scheme):
    log = small_log(study, "base", trials=40, steps=12)
    model = plugins.study(study).model(log.parameters)
    truth = log.values["/truth"][:, 1:]
    ours, numpys_ = (
        np.sqrt(((found - truth) ** 2).mean(axis=1))
        for found in (estimates(model, log, scheme), numpys(model, log))
    )
    difference = ours - numpys_
    error = difference.std(axis=0, ddof=1) / np.sqrt(len(difference))
    assert np.all(np.abs(difference.mean(axis=0)) < 4 * error)


def test_a_step_does_not_write_into_the_state_before():
    log = small_log("ungm", "base")
    model = plugins.study("ungm").model(log.parameters)
    settings = Bootstrap(particles=20, resampling="systematic", weights="logarithmic")
    filter_ = ross_eh.build(model, settings, saturates=True, transmission="lemma1")
    state = filter_.init(Streams(1, "ungm", "filter:bootstrap", [0, 1, 2, 3, 4]))
    kept = [np.copy(part) for part in state]
    filter_.step(state, 1, Seen(log.values["/received"][:, 1]))
    for part, copy in zip(state, kept, strict=True):
        np.testing.assert_array_equal(part, copy)
