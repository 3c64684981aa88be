"""Dead band, saturation, random access, signal strength and the simulator of the three targets."""

from types import SimpleNamespace

import numpy as np
import pytest

from repro.filters.families import protocol_particles
from repro.kernels import censored_likelihood, coupled_targets_step
from repro.models.coupled_targets import SignalStrength, drift
from repro.network.censoring import ABOVE, BELOW, EXACT, INSIDE, Censoring, censored
from repro.network.random_access import transmitted, transmitting_group
from repro.parameters.load import load_paper
from repro.parameters.settings import ProtocolParticles
from repro.parameters.values import ParameterError
from repro.statistics.runs import Runs
from repro.streams import Streams
from repro.studies.deadband import STUDY
from repro.studies.families.censored_network import sensors
from tests.conftest import ROOT, points, small_log

IDEAL = np.array([-11.0, -10.0, -9.99, 0.0, 9.99, 10.0, 11.0])


def test_dead_band_passes_its_boundaries():
    values, codes = censored(IDEAL, Censoring("dead band", -10.0, 10.0, 0.5))
    np.testing.assert_array_equal(values, [-11, -10, 0.5, 0.5, 0.5, 10, 11])
    np.testing.assert_array_equal(codes, [EXACT, EXACT, INSIDE, INSIDE, INSIDE, EXACT, EXACT])


def test_saturation_censors_its_boundaries():
    values, codes = censored(IDEAL, Censoring("saturation", -10.0, 10.0, 0.0))
    np.testing.assert_array_equal(values, [-10, -10, -9.99, 0, 9.99, 10, 10])
    np.testing.assert_array_equal(codes, [BELOW, BELOW, EXACT, EXACT, EXACT, ABOVE, ABOVE])


def test_group_transmits_its_own_readings():
    group = transmitting_group(np.array([0.0, 0.19, 0.2, 0.99]), [0.2, 0.8])
    np.testing.assert_array_equal(group, [0, 0, 1, 1])
    readings = np.arange(24).reshape(4, 2, 3)
    np.testing.assert_array_equal(transmitted(readings, group)[[0, 3]], [[0, 1, 2], [21, 22, 23]])


@pytest.mark.parametrize(("distance", "strength"), [(1.0, 10.0), (10.0, -10.0), (100.0, -30.0)])
def test_signal_strength_at_known_distances(distance, strength):
    law = SignalStrength(10.0, 2.0, 1.0)
    assert law.of_squared_distance(distance**2) == pytest.approx(strength, abs=1e-12)
    x, out = np.array([[3.0 + distance], [4.0], [0.0]]), np.empty(1)
    of_log = law.of_log_squared_distance()
    censored_likelihood.strengths(x, np.array([3.0, 4.0]), *of_log, out)
    assert out[0] == pytest.approx(strength, abs=1e-12)


def test_strength_is_finite_on_a_sensor():
    law, out = SignalStrength(10.0, 2.0, 1.0), np.empty(1)
    of_log = law.of_log_squared_distance()
    censored_likelihood.strengths(np.zeros((3, 1)), np.zeros(2), *of_log, out)
    assert out[0] == law.of_squared_distance(0.0) == pytest.approx(190.0)


def test_drift_is_speed_along_the_heading():
    rng = np.random.default_rng(0)
    x = rng.normal(scale=[5.0, 5.0, 20.0], size=(50, 3, 3))
    speed = np.array([0.5, 1.0, 2.0])
    px, py, phi = np.moveaxis(x, -1, 0)
    wanted = np.stack([px + speed * np.cos(phi), py + speed * np.sin(phi), phi + 0.1], axis=-1)
    np.testing.assert_allclose(drift(x, speed, 0.1), wanted, rtol=0, atol=1e-13)
    motion, moved = (speed, 0.1, np.zeros(3), np.zeros((3, 3)), 0.0, True), np.empty((3, 50))
    for node in range(3):
        coupled_targets_step.drift(np.ascontiguousarray(x[:, node].T), node, motion, moved)
        np.testing.assert_allclose(moved.T, wanted[:, node], rtol=0, atol=1e-13)


@pytest.fixture(scope="module")
def log():
    return small_log("deadband", "base", trials=400, steps=80)


def test_simulated_rates_and_noise(log):
    count = 400 * 80 * 3
    network = log.values["/network"][:, 1:]
    for share, p in ((network[..., :3] == 1, 0.2), (network[..., 3:], 0.2)):
        assert share.mean() == pytest.approx(p, abs=4 * np.sqrt(p * (1 - p) / count))
    truth = log.values["/truth"].reshape(400, 81, 3, 3)
    offset = truth[:, :, :, None, :2] - sensors(log.parameters).reshape(6, 2)
    ideal = log.values["/sensor"].reshape(400, 81, 3, 6)
    noise = ideal - (10 - 10 * np.log10((offset**2).sum(axis=-1)))
    assert noise.mean() == pytest.approx(0, abs=0.03)
    assert noise.var() == pytest.approx(0.8 * 1 + 0.2 * 36, abs=0.15)  # fourth moment 780


def test_simulated_motion(log):
    truth = log.values["/truth"].reshape(400, 81, 3, 3)
    on = log.values["/network"][:, :-1, 3:].astype(bool)
    v, turn = np.array(log.parameters.speed), log.parameters.turn_rate
    x = truth[:, :-1]
    step = truth[:, 1:] - x
    step[..., 0] -= v * np.cos(x[..., 2])
    step[..., 1] -= v * np.sin(x[..., 2])
    step[..., 2] -= turn
    others = np.sin(x).sum(axis=2, keepdims=True) - np.sin(x)
    noise = step - 0.01 * on[..., None] * others
    np.testing.assert_allclose(noise.std(axis=(0, 1, 2)), [0.03, 0.03, 0.01], rtol=0.02)
    assert np.abs(noise.mean(axis=(0, 1))).max() < 0.03 * 4.5 / np.sqrt(400 * 80)
    # alphabar c (sin phi_a + sin phi_b): the heading drift that a filter without coupling lacks
    drift = (step[..., 2]).mean(axis=(0, 1))
    np.testing.assert_allclose(drift, (0.2 * 0.01 * others[..., 2]).mean(axis=(0, 1)), atol=3e-4)
    assert (drift > 0.0005).all() and (drift < 0.004).all()


def test_truth_starts_on_the_stated_states(log):
    np.testing.assert_array_equal(
        log.values["/truth"][:, 0], np.tile(np.ravel(log.parameters.initial_states), (400, 1))
    )


def test_group_is_not_told(log):
    offered = STUDY.channels(log, slice(0, 5)).at(3, None)
    assert set(offered) == {"received", "code", "group_probability"}
    assert (offered["group_probability"] == [0.2, 0.8]).all()
    known = log._replace(parameters=log.parameters.model_copy(update={"group_known": True}))
    told = STUDY.channels(known, slice(0, 5)).at(3, None)
    group = log.values["/network"][:5, 3, :3].astype(int) - 1
    np.testing.assert_array_equal(told["group_probability"].argmax(axis=-1), group)


def test_both_studies_share_truth_settings():
    first, second = (points()[name]["base"].parameters for name in ("deadband", "saturation"))
    second = second.plain()
    differ = {key for key, value in first.plain().items() if value != second[key]}
    assert differ == {"censoring", "lower_threshold", "upper_threshold"}


def analysis():
    values = load_paper(ROOT / "params/censored_network.yaml").analysis["deadband"]
    return STUDY.Analysis.checked(values, "test")


def test_a_target_is_lost_by_position_at_any_step_after_the_first():
    error = np.zeros((4, 6, 9))
    error[1, 0, 0] = 11.0  # before the first measurement
    error[2, 3, 4] = 11.0  # py of target 2
    error[3, 3, 5] = 11.0  # a heading
    lost = STUDY.lost(Runs(error, None, np.zeros(4), {}), analysis())
    np.testing.assert_array_equal(lost, [False, False, True, False])


@pytest.mark.parametrize(
    ("build", "draws"), [(protocol_particles.auxiliary, 2), (protocol_particles.bootstrap, 1)]
)
def test_readings_that_nothing_explains_are_counted_and_weighted_equally(build, draws, log):
    filter_ = build(STUDY.model(log.parameters), ProtocolParticles(particles=50))
    before = filter_.init(Streams(1, "deadband", "filter:test", range(2)))
    kept = [np.copy(part) for part in before]
    offered = STUDY.channels(log, slice(0, 2)).at(1, None)
    probability = offered["group_probability"] * [[[1.0]], [[0.0]]]  # of no group, in trial 1
    after = filter_.step(before, 1, SimpleNamespace(**offered | {"group_probability": probability}))
    np.testing.assert_array_equal(filter_.degenerate(after), [0, 3 * draws])
    np.testing.assert_allclose(after.weights[1], 1 / 50)
    np.testing.assert_allclose(after.mean[1], after.particles[1].mean(axis=-1))
    assert np.ptp(after.weights[0]) > 1e-5
    sizes = (1 / (after.weights**2).sum(axis=-1)).mean(axis=-1)
    found = filter_.diagnostics(after)["effective_sample_size"]
    np.testing.assert_allclose(found, sizes)
    for part, copy in zip(before, kept, strict=True):  # a step leaves the state before as it is
        np.testing.assert_array_equal(part, copy)


def test_every_group_needs_a_probability():
    values = points()["deadband"]["base"].parameters.plain() | {"group_probabilities": [1.0]}
    with pytest.raises(ParameterError, match="must be of one length; they have 1 and 2 entries"):
        STUDY.Parameters.checked(values, "test")
