"""The compiled bootstrap steps against the same in NumPy."""

import numpy as np
import pytest

from repro import plugins
from repro.filters.families import ross_eh
from repro.kernels import resampling, sensor_network_step
from repro.models.sensor_network import ExponentialNoise, GaussianNoise
from repro.network.saturation import Saturation
from repro.parameters.settings import Bootstrap
from repro.streams import Streams
from tests.conftest import small_log

RNG = np.random.default_rng(2)
COUNT = 301
GAUSSIAN = GaussianNoise(np.array([0.1, 0.2]), 0.001), Saturation(0.2, 30.0)
EXPONENTIAL = ExponentialNoise(2.0, 2), Saturation(0.5, 10.0)
NOISES = {"Gaussian": np.array([0.1, 0.2, 0.001]), "exponential": np.array([2.0, 2.0, 0.0])}


def numpys(noise, z, levels, saturation, transmission):
    total = sum(
        noise.log_likelihood(z[i : i + 1], levels[i][None].copy(), i, saturation, transmission)
        for i in range(2)
    )
    weights, degenerate = resampling.normalised(total)
    return weights[0], degenerate[0]


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
        known = saturation if saturates else None
        wanted, degenerate = numpys(noise, z, levels, known, transmission)
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


@pytest.mark.parametrize("study", ["ungm", "rss_2d", "rss_3d"])
@pytest.mark.parametrize("scheme", ["systematic", "multinomial"])
def test_errors_are_those_of_numpy(study, scheme):
    log = small_log(study, "base", trials=60, steps=15)
    model = plugins.study(study).model(log.parameters)
    truth = log.values["/truth"][:, 1:]
    ours, numpys_ = (
        np.sqrt(((estimates(used, log, scheme) - truth) ** 2).mean(axis=1))
        for used in (model, model._replace(plant=None))
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
