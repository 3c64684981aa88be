"""repro.study, run, estimate and compare, as a notebook or a debugger uses them."""

import importlib
import math
from types import SimpleNamespace

import numpy as np
import pytest

import repro
from repro.errors import ReproError
from repro.filters import Filter
from repro.models.sparse import dense
from repro.parameters.settings import RaoBlackwell
from repro.runner import run as run_on_log
from tests.conftest import points

TRIALS = 4


class Still:
    """Stays where it starts: the three functions that a filter needs, and no more."""

    LABEL = "stands still"
    SEES = ("received",)

    @staticmethod
    def build(model, settings):
        def init(streams):
            return np.tile(model.initial_mean, (len(streams), 1))

        return Filter(init, step=lambda state, k, seen: state, mean=lambda state: state)


@pytest.fixture(autouse=True)
def elsewhere(tmp_path, monkeypatch):
    """Every test works in another folder than the project's."""
    monkeypatch.chdir(tmp_path)


@pytest.fixture(scope="module")
def radar():
    return repro.study("radar").simulate("loss=0.5", trials=TRIALS, steps=20)


@pytest.fixture(scope="module")
def linear():
    return repro.study("linear_losses").simulate("loss=0.3", trials=TRIALS, steps=20)


def model_of(log):
    return repro.study(log.study).model(log.point)


def test_a_log_has_the_trials_and_parameters_that_it_is_asked_for():
    study = repro.study("radar")
    log = study.simulate("loss=0.5", trials=3, steps=10, loss_probability=1.0)
    assert log.values["/truth"].shape == (3, 11, 6)
    assert (log.field("/network", "gamma") == 0).all()
    assert study.points["loss=0.5"].parameters.loss_probability == 0.5
    assert "loss=0.5" in repr(study)


def test_a_log_is_the_workflows_unless_its_seed_is_another():
    study = repro.study("linear_losses")
    first, again = (study.simulate("loss=0.3", trials=2, steps=5) for _ in range(2))
    other = study.simulate("loss=0.3", trials=2, steps=5, seed=first.seed + 1)
    np.testing.assert_array_equal(first.values["/received"], again.values["/received"])
    assert (first.values["/received"] != other.values["/received"]).all()


def test_name_module_and_object_run_alike(radar):
    module = importlib.import_module("repro.filters.rbpf")
    settings = points()["radar"]["loss=0.5"].filters["rbpf"]
    by_hand = run_on_log(radar, "rbpf", settings)[0]
    alike = SimpleNamespace(
        LABEL=module.LABEL,
        SEES=module.SEES,
        STREAM=getattr(module, "STREAM", "rbpf"),
        Settings=RaoBlackwell,
        build=module.build,
    )
    for found in (
        repro.run("rbpf", radar),
        repro.run(module, radar),
        repro.run(alike, radar, **settings),
    ):
        assert found.label == module.LABEL
        np.testing.assert_array_equal(found.estimate, by_hand)
        np.testing.assert_array_equal(found.error, by_hand - radar.values["/truth"])
    few = repro.run("rbpf", radar, particles=2)
    assert (few.estimate != by_hand).any()


def test_a_filter_without_anything_optional_runs_and_is_compared(radar):
    found = repro.run(Still, radar)
    assert found.runs.claimed is None
    assert found.squared_error.shape == (TRIALS, 20)
    table = repro.compare({"mine": Still, "few": ("rbpf", {"particles": 5}), "iekf": "iekf"}, radar)
    assert set(table.index) == {"mine", "few", "iekf"}
    assert list(table["rmse"]) == sorted(table["rmse"])
    assert table["verdict"].iloc[0] == "best" and table["difference"].iloc[0] == 0.0


def test_the_tolerance_of_a_comparison_is_that_of_the_run(radar, monkeypatch):
    filters = {"mine": Still, "iekf": "iekf"}
    assert repro.compare(filters, radar).loc["mine", "verdict"] == "worse"
    lax = SimpleNamespace(tolerance=1e9)
    monkeypatch.setattr("repro.inspect.interface.load_run", lambda path, overrides: lax)
    assert repro.compare(filters, radar).loc["mine", "verdict"] == "not decided"


@pytest.mark.parametrize("tolerance", [math.nan, -1.0, 0])
def test_a_tolerance_that_decides_nothing_is_refused(tolerance, radar):
    with pytest.raises(ReproError, match="tolerance: "):
        repro.compare({"ekf": "ekf"}, radar, tolerance=tolerance)


def test_differences_are_paired(radar):
    table = repro.compare({"mine": Still, "iekf": "iekf"}, radar)
    roots = {name: repro.run(f, radar).squared_error for name, f in (("m", Still), ("i", "iekf"))}

    def difference(trials):
        means = {name: np.sqrt(squared[trials].mean(axis=0)) for name, squared in roots.items()}
        return means["m"].mean() - means["i"].mean()

    every = np.arange(TRIALS)
    left_out = np.array([difference(np.delete(every, i)) for i in every])
    spread = np.sqrt((TRIALS - 1) / TRIALS * ((left_out - left_out.mean()) ** 2).sum())
    worse = table.loc["mine"] if table.index[0] == "iekf" else -table.loc["iekf", "difference":]
    assert abs(worse["difference"]) == pytest.approx(abs(difference(every)))
    assert abs(worse["difference_mcse"]) == pytest.approx(spread)


@pytest.mark.parametrize("name", ["ekf", "iekf", "bkf_1", "bkf_2"])
def test_plain_arrays_of_all_trials_give_what_the_log_gives(name, radar, linear):
    for log, first in ((radar, 1), (linear, 0)):
        arrays = log.values["/received"], log.field("/network", "gamma")
        found = repro.estimate(name, model_of(log), *arrays, first_step=first)
        np.testing.assert_array_equal(found, repro.run(name, log).estimate)


def test_plain_arrays_of_a_single_record(radar, linear):
    for log, first in ((radar, 1), (linear, 0)):
        wanted = repro.run("iekf", log).estimate[2]
        received, arrival = log.values["/received"][2], log.field("/network", "gamma")[2]
        found = repro.estimate("iekf", model_of(log), received, arrival, first_step=first)
        np.testing.assert_array_equal(found, wanted)
    alone = repro.estimate(
        "iekf", model_of(linear), received[:, 0].tolist(), arrival == 1, first_step=0
    )
    np.testing.assert_array_equal(alone, wanted)


def test_particles_on_plain_arrays_repeat_with_their_seed(radar):
    received = radar.values["/received"][0]
    first, again, other = (
        repro.estimate("rbpf", model_of(radar), received, seed=s, settings={"particles": 10})
        for s in (3, 3, 4)
    )
    np.testing.assert_array_equal(first, again)
    assert (first != other).any()


@pytest.mark.parametrize("name", ["ekf", "iekf", "bkf_1", "bkf_2", "rbpf", "rbpf_fast"])
def test_a_model_with_dense_jacobians_gives_the_same(name, radar):
    sparse = model_of(radar)

    def as_array(jacobian):
        def of(x, other):
            return dense(jacobian(x, other), x.shape[:-1], x.shape[-1])

        return of

    written_with_arrays = sparse._replace(
        transition_jacobian=as_array(sparse.transition_jacobian),
        measurement_jacobian=as_array(sparse.measurement_jacobian),
    )
    arrays = radar.values["/received"], radar.field("/network", "gamma")
    settings = {"particles": 20} if name.startswith("rbpf") else {}
    found, wanted = (
        repro.estimate(name, model, *arrays, settings=settings)
        for model in (written_with_arrays, sparse)
    )
    np.testing.assert_allclose(found, wanted, rtol=1e-9, atol=1e-9)


def test_a_closed_loop_is_compared_by_its_flights():
    log = repro.study("quadrotor").simulate("nominal", trials=2, steps=30)
    table = repro.compare({"iekf": "iekf", "true_state": "true_state"}, log)
    assert np.isfinite(table["rmse"]).all()


MISTAKES = {
    "there is no src/repro/studies/rader.py": lambda log: repro.study("rader"),
    "no point 'p=0.5'; the points are loss=": lambda log: repro.study("radar").simulate("p=0.5"),
    "loss_probabilty": lambda log: repro.study("radar").simulate("loss=0.5", loss_probabilty=0.1),
    "loss_probability": lambda log: repro.study("radar").simulate("loss=0.5", loss_probability=2),
    "trials": lambda log: repro.study("radar").simulate("loss=0.5", trials=0),
    "there is no src/repro/filters/ukf.py": lambda log: repro.run("ukf", log),
    "defines no SEES": lambda log: repro.run(SimpleNamespace(LABEL="mine"), log),
    "particels": lambda log: repro.run("rbpf", log, particels=3),
    "particles": lambda log: repro.run("rbpf", log, particles=0),
    "it needs a LinearModel; this study has a Model": lambda log: repro.run("omvf", log),
    "no filter is given": lambda log: repro.compare({}, log),
    "the log has no /truth": lambda log: repro.compare({"iekf": "iekf"}, without_truth(log)),
    "received (21, 2), arrival (20,)": lambda log: estimated(log, slice(21), slice(20)),
    "channel 'arrival', which this study does not have": lambda log: repro.estimate(
        "iekf", model_of(log), log.values["/received"]
    ),
    "arrival must be (steps,): received (4, 21), arrival (4, 21)": lambda log: repro.estimate(
        "iekf", model_of(log), log.values["/received"][..., 0], log.field("/network", "gamma")
    ),
    "has no initial_mean": lambda log: repro.estimate("iekf", {}, [1.0, 2.0]),
    "received is a single number": lambda log: repro.estimate("iekf", model_of(log), 1.0),
    "received is not an array of numbers": lambda log: repro.estimate(
        "iekf", model_of(log), [[1.0, 2.0], [1.0]]
    ),
}


def without_truth(log):
    return log._replace(values={t: v for t, v in log.values.items() if t != "/truth"})


def estimated(log, received, arrival):
    arrays = log.values["/received"][0][received], log.field("/network", "gamma")[0][arrival]
    return repro.estimate("iekf", model_of(log), *arrays)


@pytest.mark.parametrize("message", MISTAKES)
def test_a_mistake_ends_in_one_line(message, radar):
    with pytest.raises(ReproError) as raised:
        MISTAKES[message](radar)
    assert message in str(raised.value)
    assert "\n" not in str(raised.value)


def test_a_log_without_truth_has_estimates_and_no_errors(radar):
    found = repro.run("iekf", without_truth(radar))
    assert np.isfinite(found.estimate).all() and np.isnan(found.error).all()
