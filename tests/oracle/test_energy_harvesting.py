"""PF-ROSS-EH and what it is built on against exact answers [energy_harvesting]."""

import numpy as np
import pytest
from scipy import stats

from repro import plugins
from repro.filters.families import ross_eh
from repro.kernels import sensor_network_step as kernels
from repro.models.rss import SignalStrength, process_root
from repro.models.sensor_network import ExponentialNoise, GaussianNoise, SensorNetwork
from repro.network import energy_harvesting
from repro.network.energy_harvesting import EnergyQueue
from repro.network.saturation import Saturation, saturated
from repro.parameters.load import load_paper
from repro.parameters.settings import Bootstrap
from repro.runner import run
from repro.simulate import simulated
from repro.streams import Streams
from tests.conftest import ROOT

PAPER = load_paper(ROOT / "params" / "energy_harvesting.yaml")
PI_1 = np.array(PAPER.studies["ungm"]["base"].parameters.harvest_transition)
SEED = 7
BOOTSTRAP = {"resampling": "systematic", "weights": "logarithmic"}


def log_of(study, trials, point="base", **changes):
    parameters = PAPER.studies[study][point].parameters
    parameters = type(parameters).checked({**parameters.plain(), **changes}, "test")
    return simulated(study, point, parameters, SEED, np.arange(trials))


def direct(noise_sum, noise_channel, z, level, saturation, transmission):
    """(15) as it is printed, from the densities."""
    gbar = saturation.probability
    sent = (1 - gbar) * noise_sum(z - level)
    sent += gbar * noise_sum(z - saturated(level, saturation.level))
    return transmission * sent + (1 - transmission) * noise_channel(z)


def likelihood(noise, z, levels, saturation, transmission):
    """That of the kernels, (len(z), len(levels))."""
    network, values = ross_eh.network(transmission, saturation), np.ones((len(z), len(levels)))
    for row, received in zip(values, z, strict=True):
        if isinstance(noise, GaussianNoise):
            kernels.gaussian_likelihood(levels, received, 0.101, 0.001, network, row)
        else:
            kernels.exponential_likelihood(levels, received, noise.mean, network, row)
    return values


GAUSSIAN = (
    GaussianNoise(np.array([0.1]), 0.001),
    stats.norm(scale=np.sqrt(0.101)).pdf,
    stats.norm(scale=np.sqrt(0.001)).pdf,
    Saturation(0.2, 30.0),
    np.array([-41.0, -30.0, -22.0, 1.5, 33.0]),
    np.linspace(-50, 50, 100_001),
)
EXPONENTIAL = (
    ExponentialNoise(2.0, 2),
    stats.gamma(2, scale=2.0).pdf,
    stats.expon(scale=2.0).pdf,
    Saturation(0.5, 10.0),
    np.array([0.0, 3.0, 9.99, 14.0, 40.0]),
    np.linspace(0, 150, 150_001),
)


@pytest.mark.parametrize("family", [GAUSSIAN, EXPONENTIAL], ids=["Gaussian", "exponential"])
@pytest.mark.parametrize("transmission", [0.3, 1.0])
def test_likelihood_is_as_printed_and_integrates_to_one(family, transmission):
    noise, density_sum, density_channel, saturation, levels, z = family
    level = np.broadcast_to(levels, (len(z), len(levels)))
    ours = likelihood(noise, z, levels, saturation, transmission)
    wanted = direct(density_sum, density_channel, z[:, None], level, saturation, transmission)
    np.testing.assert_allclose(ours, wanted, rtol=1e-9, atol=1e-280)
    np.testing.assert_allclose(np.trapezoid(ours, z, axis=0), 1.0, atol=1e-3)
    without = likelihood(noise, z, levels, None, transmission)
    none = Saturation(0.0, saturation.level)
    wanted = direct(density_sum, density_channel, z[:, None], level, none, transmission)
    np.testing.assert_allclose(without, wanted, rtol=1e-9, atol=1e-280)


def test_gaussian_likelihood_far_out_keeps_its_order():
    saturation, level = GAUSSIAN[3], np.linspace(-60.0, -31.0, 30)
    for transmission, known in ((1.0, saturation), (0.6, saturation), (1.0, None)):
        values, network = np.zeros(30), ross_eh.network(transmission, known)
        kernels.gaussian_log_likelihood(level, 25.0, 0.101, 0.001, network, values)
        assert np.all(np.isfinite(values))
    np.testing.assert_allclose(
        values, stats.norm(scale=np.sqrt(0.101)).logpdf(25.0 - level), rtol=1e-12
    )


@pytest.mark.parametrize("family", [GAUSSIAN, EXPONENTIAL], ids=["Gaussian", "exponential"])
def test_sum_of_noises_is_the_convolution(family):
    noise, _, channel, *_ = family
    # (28) by the trapezoidal rule, far finer than either noise
    if isinstance(noise, GaussianNoise):
        inner, nu = np.linspace(-0.5, 0.5, 20_001), stats.norm(scale=np.sqrt(0.1)).pdf
        errors = np.array([-1.0, 0.0, 0.2, 0.9])
        convolved = [np.trapezoid(nu(e - inner) * channel(inner), inner) for e in errors]
    else:
        errors = np.array([0.1, 1.0, 4.0, 20.0])
        convolved = []
        for e in errors:
            inner = np.linspace(0, e, 20_001)
            product = stats.expon(scale=2.0).pdf(e - inner) * channel(inner)
            convolved.append(np.trapezoid(product, inner))
    # Without impairments the likelihood of a level of zero is the density of the sum.
    ours = likelihood(noise, errors, np.zeros(1), None, 1.0)
    np.testing.assert_allclose(ours[:, 0], convolved, rtol=1e-6)


def test_lemma_1_is_exact_for_identical_rows_only():
    rows = np.tile([0.4, 0.3, 0.2, 0.1], (4, 1))
    uniform = np.full(4, 0.25)
    alike = EnergyQueue(rows, uniform, 1, 3)
    law = energy_harvesting.joint_chain(alike, 40).sum(axis=2)
    np.testing.assert_allclose(energy_harvesting.lemma_1(alike, 40), law, atol=1e-14)
    markov = EnergyQueue(PI_1, uniform, 1, 3)
    exact = energy_harvesting.joint_chain(markov, 40).sum(axis=2)
    assert np.abs(energy_harvesting.lemma_1(markov, 40) - exact)[2:].max(axis=1).min() > 0.01
    # Pi = I: without energy exactly if H = 0, the probability of which Lemma 1 puts at 1/32
    frozen = EnergyQueue(np.eye(4), uniform, 1, 3)
    probability = energy_harvesting.transmission_probability
    np.testing.assert_allclose(probability(frozen, 60, "exact")[1:], 0.75, atol=1e-14)
    assert probability(frozen, 400, "lemma1")[-1] == pytest.approx(31 / 32, abs=1e-6)


@pytest.mark.parametrize("capacity", [2, 3, 5])  # less than, as much as and more than Hbar
def test_joint_chain_is_the_simulated_chain(capacity):
    queue = EnergyQueue(PI_1, np.full(4, 0.25), 1, capacity)
    uniforms = np.random.default_rng(3).random((40_000, 13))
    energy = energy_harvesting.energy(energy_harvesting.harvest(uniforms, queue), queue)
    law = energy_harvesting.joint_chain(queue, 12).sum(axis=2)
    for k in range(1, 13):
        share = np.bincount(energy[:, k], minlength=capacity + 1) / len(energy)
        error = np.sqrt(law[k] * (1 - law[k]) / len(energy))
        assert np.all(np.abs(share - law[k]) <= 4.5 * error)
    np.testing.assert_allclose(energy_harvesting.lemma_1(queue, 12).sum(axis=1), 1.0, atol=1e-14)


def test_truth_spreads_as_the_white_noise_acceleration_model():
    log = log_of("rss_2d", 3000, steps=30)
    truth, acceleration = log.values["/truth"], log.parameters.acceleration_variance
    for axis in (0, 1):
        for k in (1, 30):
            for component, wanted in ((2 * axis, k**3 / 3), (2 * axis + 1, k)):
                variance = truth[:, k, component].var(ddof=1)
                error = acceleration * wanted * np.sqrt(2 / len(truth))
                assert abs(variance - acceleration * wanted) < 4 * error
    # without noise the target moves straight on
    straight = truth[:, 0] + 30 * truth[:, 0, [1, 1, 3, 3]] * [1, 0, 1, 0]
    spread = np.sqrt(acceleration * np.array([30**3 / 3, 30, 30**3 / 3, 30]) / len(truth))
    assert np.all(np.abs((truth[:, 30] - straight).mean(axis=0)) < 4 * spread)


@pytest.mark.parametrize("study", ["ungm", "rss_2d", "rss_3d"])
def test_without_impairments_the_filters_are_one(study):
    always = np.tile([0.0, 0.5, 0.3, 0.2], (4, 1)).tolist()
    log = log_of(study, 4, steps=20, saturation_probability=0.0, harvest_transition=always)
    settings = BOOTSTRAP | {"particles": 100}
    names = ("pf_ross_eh", "pf_ross", "pf_eh", "spf", "spf_im")
    first, *others = (run(log, name, settings)[0] for name in names)
    for other in others:
        np.testing.assert_array_equal(other, first)
    # and so they are where saturation may occur but is out of reach
    log = log_of(study, 4, steps=20, saturation_level=1e9, harvest_transition=always)
    first, *others = (run(log, name, settings)[0] for name in names)
    for other in others:
        np.testing.assert_allclose(other, first, rtol=1e-9)


def test_saturated_and_lost_measurements_are_what_the_log_says():
    log = log_of("rss_2d", 50)
    of = {topic: values[:, 1:] for topic, values in log.values.items()}
    sensors, level = log.parameters.sensors, log.parameters.saturation_level
    network = of["/network"].reshape(50, -1, sensors, 4)
    gamma, sent = network[..., 2], network[..., 3]
    ideal, y, z = of["/ideal"], of["/sensor"], of["/received"]
    n = z - np.where(sent == 1, y, 0.0)
    assert abs(n.var() / log.parameters.channel_variance - 1) < 0.05
    clipped = (gamma == 1) & (ideal - y - n < -1e-9)
    assert clipped.any() and abs(gamma.mean() - 0.2) < 0.02
    # a saturated output is minus the level and the sensor's noise, whatever the distance
    assert abs(y[clipped].mean() + level) < 0.05 and y[clipped].std() < 0.4
    np.testing.assert_allclose(ideal[gamma == 0], (y + n)[gamma == 0], atol=1e-9)


def test_linear_weights_underflow_and_skip_updates():
    """A lost packet is e^-3000 away from any level: zero for all particles without logarithms."""
    log = log_of("rss_2d", 6, steps=40)
    settings = BOOTSTRAP | {"particles": 200}
    linear = run(log, "spf", settings | {"weights": "linear"})[1].degenerate
    missed = (log.values["/network"].reshape(6, -1, 4, 4)[:, 1:, :, 3] == 0).any(axis=2).sum(axis=1)
    assert np.all(linear >= missed) and missed.min() > 0
    assert not run(log, "spf", settings)[1].degenerate.any()
    # where nothing underflows the two agree
    log = log_of("ungm", 6, steps=20)
    both = (run(log, "pf_ross_eh", settings | {"weights": w})[0] for w in ("linear", "logarithmic"))
    np.testing.assert_allclose(*both, rtol=1e-9)


def test_transmission_probability_cancels_where_losses_are_seen():
    """A lost packet lies near 0 dBm, far from any level, so that any lambda gives the same."""
    log = log_of("rss_2d", 10, steps=40)
    model = plugins.study("rss_2d").model(log.parameters)
    settings = Bootstrap(particles=200, **BOOTSTRAP)
    estimates = []
    for rule in ("lemma1", "exact"):
        filter_ = ross_eh.build(model, settings, saturates=True, transmission=rule)
        estimates.append(run_filter(filter_, log))
    np.testing.assert_allclose(*estimates, atol=1e-6)


def run_filter(filter_, log):
    """Estimates (trials, steps + 1, n) of a filter that needs no module."""
    channels = plugins.study(log.study).channels(log, slice(None))
    state = filter_.init(Streams(log.seed, log.study, "filter:bootstrap", log.trials.tolist()))
    estimates = [filter_.mean(state)]
    for k in range(1, log.values["/truth"].shape[1]):
        state = filter_.step(state, k, Seen(channels.at(k, None)))
        estimates.append(filter_.mean(state))
    return np.stack(estimates, axis=1)


class Seen:
    def __init__(self, offered):
        self.__dict__.update(offered)


def test_linear_gaussian_is_the_kalman_filter():
    """The level of a sensor that is far away is linear in the position, here one dBm a metre."""
    trials, steps, r, far = 20, 15, 0.3, 1e6
    a, root = np.array([[1.0, 1.0], [0.0, 1.0]]), process_root(1.0, 0.2)
    rng = np.random.default_rng(5)
    x, mean, covariance = rng.standard_normal((trials, 2)), np.zeros((trials, 2)), np.eye(2)
    z, kalman, deviation = np.zeros((trials, steps + 1)), [mean], [1.0]
    for k in range(1, steps + 1):
        x = x @ a.T + rng.standard_normal((trials, 2)) @ root.T
        z[:, k] = x[:, 0] + np.sqrt(r) * rng.standard_normal(trials)
        mean, covariance = mean @ a.T, a @ covariance @ a.T + root @ root.T
        gain = covariance[:, 0] / (covariance[0, 0] + r)
        mean = mean + (z[:, k] - mean[:, 0])[:, None] * gain
        covariance = covariance - np.outer(gain, covariance[0])
        kalman.append(mean)
        deviation.append(np.sqrt(np.diag(covariance)))
    model = SensorNetwork(
        initial_mean=np.zeros(2),
        sensors=1,
        steps=steps,
        draw_prior=lambda streams, particles: streams.standard_normal(2, particles),
        plant=SignalStrength(1.0, root, np.array([[far]]), 0.0, far * np.log(10) / 10, far),
        noise=GaussianNoise(np.array([r - 0.1]), 0.1),
    )
    settings = Bootstrap(particles=20_000, **BOOTSTRAP)
    filter_ = ross_eh.build(model, settings, saturates=False, transmission=None)
    streams = Streams(SEED, "linear", "filter", range(trials))
    state, gaps = filter_.init(streams), []
    for k in range(1, steps + 1):
        state = filter_.step(state, k, Seen({"received": z[:, k : k + 1]}))
        gaps.append((filter_.mean(state) - kalman[k]) / deviation[k])
    gaps = np.array(gaps)
    rms = np.sqrt((gaps**2).mean())
    assert rms < 3 / np.sqrt(20_000)  # in posterior standard deviations: fewer particles count
    assert np.abs(gaps.mean(axis=(0, 1))).max() < 4 * rms / np.sqrt(trials)  # no bias
