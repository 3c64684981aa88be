"""The quadrotor's loop against what must hold of it [unknown_losses Sec. VI-C]."""

import sys
from types import ModuleType

import numpy as np
import pytest

from repro import plugins, runner
from repro.filters import Filter
from repro.logs import read_log
from repro.models import quadrotor as model
from repro.runner import run
from repro.simulate import simulate, simulated
from repro.statistics.shards import Shards
from repro.studies import quadrotor as study
from tests.conftest import points

POINT = points()["quadrotor"]["nominal"]
SETTINGS = POINT.filters | {"rbpf": POINT.filters["rbpf_fast"]}
ON_THE_ESTIMATE = ("ekf_no_loss", "iekf", "bkf_1", "bkf_2", "rbpf", "rbpf_fast", "ekf")


def disturbances(trials=2, **changes):
    parameters = POINT.parameters.model_copy(update=changes)
    return simulated("quadrotor", "nominal", parameters, 1, np.arange(trials))


def flown(log, name):
    return run(log, name, SETTINGS.get(name, {}))


@pytest.mark.parametrize("name", ON_THE_ESTIMATE)
def test_without_losses_every_filter_flies_the_same(name):
    log = disturbances(steps=150, loss_probability=0.0)
    expected, ours = (flown(log, f) for f in ("ekf_no_loss", name))
    np.testing.assert_allclose(ours[0], expected[0], rtol=0, atol=1e-8)
    np.testing.assert_allclose(ours[1].flown["/truth"], expected[1].flown["/truth"], atol=1e-8)


def test_both_algorithms_of_the_rbpf_fly_the_same_to_the_last_bit():
    log = disturbances(steps=150)
    first, second = (flown(log, name) for name in ("rbpf", "rbpf_fast"))
    np.testing.assert_array_equal(first[0], second[0])
    np.testing.assert_array_equal(first[1].recorded["arrived"], second[1].recorded["arrived"])


def test_with_exact_measurements_the_estimate_is_the_truth():
    """Then the flight is the one on the true state, whatever is lost."""
    exact = dict(measurement_deviations=(1e-7,) * 4, initial_deviations=(1e-7,) * 4)
    log = disturbances(steps=150, process_deviations=(1e-7,) * 4, **exact)
    truth = flown(log, "true_state")[1].flown["/truth"]
    for name in ("iekf", "bkf_1"):
        np.testing.assert_allclose(flown(log, name)[1].flown["/truth"], truth, atol=1e-5)


@pytest.mark.parametrize("loss", [0.1, 0.2, 0.3])
def test_the_ekf_that_ignores_losses_flies_too_high(loss):
    """It averages y = gamma x + v, (1 - p) x, and the loop holds the estimate at the command."""
    log = disturbances(trials=8, steps=1000, loss_probability=loss)
    estimate, runs = flown(log, "ekf")
    altitude = runs.recorded["position"][:, 300:, 2].mean()
    assert estimate[:, 300:, 11].mean() == pytest.approx(3.0, abs=0.06)
    assert altitude == pytest.approx(3 / (1 - loss), rel=0.02)
    known = flown(log, "iekf")[1].recorded["position"]
    assert known[:, 300:, 2].mean() == pytest.approx(3.0, abs=0.05)


def test_on_the_true_state_only_the_controllers_lag_is_left():
    """The position error is the velocity command: at 0.2 m/s the flight is 0.2 m behind."""
    log = disturbances(trials=1, steps=3500, process_deviations=(0.0,) * 4)
    position = flown(log, "true_state")[1].recorded["position"][0]
    path = study.reference(log.parameters)[:, :3]
    lag = np.linalg.norm(position - path, axis=1)
    np.testing.assert_allclose(lag[[250, 500, 1000, 2000]], 0.2, atol=0.006)
    assert lag[-1] < 1e-3  # the path ends at rest


def test_a_flight_that_tumbles_is_ended_and_stays_finite():
    log = disturbances(trials=4, steps=1500)
    changed = log.parameters.model_copy(update={"tumbled_above_deg": 3.0})
    log = log._replace(parameters=changed)
    estimate, runs = flown(log, "ekf")
    end = runs.recorded["end"]
    assert (end < 1501).any() and study.ended(runs).any()
    truth = runs.flown["/truth"]
    for arrays in (estimate, runs.error, truth, *runs.recorded.values()):
        assert np.isfinite(arrays).all()
    for flight, first in enumerate(end):
        held = truth[flight, first - 1 :]
        np.testing.assert_array_equal(held, np.broadcast_to(held[0], held.shape))
        assert np.abs(truth[flight, :first, 3:5]).max() <= np.deg2rad(3.0)
        assert (truth[flight, first - 2] != held[0]).any()
    shards = Shards([lambda: runs], [len(end)])
    rows = {f"{metric} {part}": s.value for metric, part, s in study.STUDY.rows(shards, None)}
    assert rows["tumbled flight"] == (end < 1501).mean()
    assert rows["end_time flight"] == pytest.approx(np.minimum(end, 1500).mean() * 0.01)
    assert np.isfinite(list(rows.values())).all()


def test_an_estimate_that_is_not_finite_ends_its_flight_alone(monkeypatch):
    """A filter that breaks down in one flight at step 20."""
    broken = ModuleType("repro.filters.broken")
    broken.LABEL, broken.SEES = "broken", ("truth",)

    def step(state, k, seen):
        estimate = seen.truth.copy()
        if k >= 20:
            estimate[1] = np.nan
        return estimate

    broken.build = lambda system, settings: Filter(
        lambda streams: np.zeros((len(streams), 12)), step, mean=lambda state: state
    )
    monkeypatch.setitem(sys.modules, "repro.filters.broken", broken)
    log = disturbances(steps=60)
    estimate, runs = run(log, "broken", {})
    np.testing.assert_array_equal(runs.recorded["end"], [61, 20])
    np.testing.assert_array_equal(estimate[0], flown(log, "true_state")[0][0])
    np.testing.assert_array_equal(estimate[1, 20:], np.tile(estimate[1, 19], (41, 1)))


def test_flight_log_replays(tmp_path):
    """Throttles give the rotor speeds, those the truth, and that what was received."""
    parameters = POINT.parameters.model_copy(update={"steps": 80})
    log_path = tmp_path / "log.mcap"
    simulate("quadrotor", "nominal", parameters.plain(), 1, (0, 2), log_path)
    log = read_log(log_path)
    _, runs = run(log, "bkf_1", {})
    flight = runner.flown(log, "bkf_1", {})
    assert set(flight.fields) == {"/truth", "/received", "/estimate", "/reference", "/throttle"}
    truth, throttle = flight.values["/truth"], flight.values["/throttle"]
    frame, motor = study.airframe(parameters), study.motor(parameters)
    speeds = np.full((2, 4), 4000.0)
    for k in range(80):
        after = model.transition(frame, truth[:, k], speeds, 0.01) + log.values["/process"][:, k]
        np.testing.assert_array_equal(truth[:, k + 1], after)
        speeds = model.motor_step(motor, speeds, throttle[:, k], 0.01)
    gamma = log.field("/network", "gamma")[:, :, None]
    np.testing.assert_array_equal(flight.values["/received"], gamma * truth + log.values["/sensor"])
    np.testing.assert_array_equal(runs.error, flight.values["/estimate"] - truth)
    np.testing.assert_array_equal(flight.values["/reference"][0], study.reference(parameters))


@pytest.mark.parametrize("name", ("true_state", *ON_THE_ESTIMATE))
def test_batches_do_not_matter_and_the_future_is_not_seen(name):
    log = disturbances(trials=3, steps=60)
    together = flown(log, name)[0]
    values = {topic: array[1:2] for topic, array in log.values.items()}
    alone = flown(log._replace(values=values, trials=log.trials[1:2]), name)[0]
    np.testing.assert_array_equal(alone, together[1:2])
    later = log.values["/sensor"].copy()
    later[:, 31:] *= -1
    changed = flown(log._replace(values=log.values | {"/sensor": later}), name)[0]
    np.testing.assert_array_equal(changed[:, :31], together[:, :31])
    if name != "true_state":
        assert (changed[:, 31] != together[:, 31]).any()


def test_only_the_true_state_sees_the_truth():
    assert [
        n for n in ("true_state", *ON_THE_ESTIMATE) if "truth" in plugins.filter_module(n).SEES
    ] == ["true_state"]


@pytest.mark.parametrize("name", ["iekf", "rbpf_fast"])
def test_errors_are_as_large_as_the_filter_claims(name, monkeypatch):
    """Ensemble mean square against the mean claimed variance, but for the slow position."""
    monkeypatch.setattr(study.Quadrotor, "keeps_claimed_variance", True)
    runs = flown(disturbances(trials=20, steps=500), name)[1]
    squared, claimed = (runs.error**2)[:, 100:, :9], runs.claimed[:, 100:, :9]
    np.testing.assert_allclose(squared.mean((0, 1)) / claimed.mean((0, 1)), 1.0, atol=0.25)
