"""Filters that break their contract get one line that says where and what to do."""

import sys
from types import ModuleType

import numpy as np
import pytest

from repro.errors import ReproError
from repro.filters import Filter
from repro.runner import faults, run
from tests.conftest import small_log

WHERE = "filter mine on linear_delays, arrival=0.5: "


def install(monkeypatch, step=None, mean=None, sees=("received",), build=None, **optional):
    module = ModuleType("repro.filters.mine")
    module.LABEL, module.SEES = "mine", sees
    built = Filter(
        init=lambda streams: np.zeros((len(streams), 2)),
        step=step or (lambda state, k, seen: state),
        mean=mean or (lambda state: state),
        **optional,
    )
    module.build = build or (lambda model, settings: built)
    monkeypatch.setitem(sys.modules, "repro.filters.mine", module)
    return module


def run_mine(name="mine", **settings):
    return run(small_log("linear_delays", "arrival=0.5", 3), name, settings)


@pytest.mark.parametrize(
    ("broken", "message"),
    [
        (
            {"step": lambda state, k, seen: state * np.nan},
            "trial 0 at step 1 is not finite; fix step or mean",
        ),
        (
            {"mean": lambda state: state[:, :1]},
            r"mean.state. has shape \(3, 1\) at step 0, trials 0 to 2; it must be \(trials, n\) =",
        ),
        (
            {"step": lambda state, k, seen: seen.delay},
            "at step 1, trials 0 to 2: reads the channel 'delay', which its SEES does not declare",
        ),
        (
            {"sees": ("truth",)},
            "SEES names the channel 'truth', which this study does not have; it has received",
        ),
        (
            {"step": lambda state, k, seen: 1 / 0},
            r"step\(state, k, seen\) at step 1, trials 0 to 2: ZeroDivisionError: division by zero",
        ),
        (
            {"variance": lambda state: np.ones((3, 3))},
            r"variance\(state\) has shape \(3, 3\) at step 0, .* \(n\) = \(2,\) or \(trials, n\)",
        ),
        (
            {"diagnostics": lambda state: {"gain": 1.0}},
            r"diagnostics\(state\)\['gain'\] has shape \(\) at step 0, .* \(trials\) = \(3,\)",
        ),
        ({"degenerate": lambda state: state}, r"degenerate\(state\) has shape \(3, 2\) at step"),
        ({"mean": lambda state: state + 1j}, r"mean\(state\) holds complex128 at step 0"),
        ({"build": lambda model, settings: None}, "build returned a NoneType; it must be a Filter"),
    ],
)
def test_a_broken_filter_gets_one_line(broken, message, monkeypatch):
    install(monkeypatch, **broken)
    with pytest.raises(ReproError, match=message) as error:
        run_mine()
    assert "\n" not in str(error.value) and str(error.value).startswith(WHERE)


def test_a_string_as_sees(monkeypatch):
    install(monkeypatch, sees="received")
    with pytest.raises(ReproError, match=r"filter mine: .* write a tuple: SEES = \('received',\)"):
        run_mine()


def test_an_exception_keeps_the_filters_own_lines_alone(monkeypatch):
    install(monkeypatch, step=lambda state, k, seen: np.linalg.inv(np.zeros((2, 2))))
    with pytest.raises(faults.FilterError, match="LinAlgError: Singular matrix") as error:
        run_mine()
    details = error.value.details
    assert "np.linalg.inv(np.zeros((2, 2)))" in details and f'"{__file__}"' in details
    assert "repro/runner" not in details


def test_a_filter_that_is_not_there_or_lacks_a_name(monkeypatch):
    with pytest.raises(ReproError, match=r"there is no src/repro/filters/nowhere\.py"):
        run_mine("nowhere")
    del install(monkeypatch).LABEL
    with pytest.raises(ReproError, match="defines no LABEL"):
        run_mine()


def with_gain(model, settings):
    return Filter(
        init=lambda streams: np.full((len(streams), 2), settings["gain"]),
        step=lambda state, k, seen: state,
        mean=lambda state: state,
    )


def test_plain_settings_are_checked_against_what_the_filter_reads(monkeypatch):
    install(monkeypatch, build=with_gain)
    run_mine(gain=0.5)
    missing = r"the setting 'gain' is missing; .*rule: params: settings=dict\(gain=...\)"
    with pytest.raises(ReproError, match=f"^{WHERE}{missing}"):
        run_mine(gian=0.5)
    with pytest.raises(ReproError, match=f"^{WHERE}the setting 'gian' is never used; fix the name"):
        run_mine(gain=0.5, gian=0.5)


@pytest.mark.parametrize(
    "read",
    [
        lambda settings: dict(**settings),
        lambda settings: {"gain": 1.0} | settings,
        lambda settings: settings | {"gain": 1.0},
        lambda settings: list(settings.items()),
        lambda settings: settings.get("gain", 1.0),
        lambda settings: "gain" in settings,
        lambda settings: settings.copy(),
    ],
)
def test_settings_may_be_read_in_any_way(read, monkeypatch):
    def build(model, settings):
        read(settings)
        return with_gain(model, {"gain": 0.0})

    install(monkeypatch, build=build)
    run_mine(gain=0.5)


def test_a_slow_filter_shows_progress(monkeypatch, capsys):
    seconds = iter(range(0, 10_000, 4))
    monkeypatch.setattr(faults, "PROGRESS_EVERY", 10.0)
    monkeypatch.setattr(faults.time, "monotonic", lambda: next(seconds))
    install(monkeypatch)
    run_mine()
    lines = capsys.readouterr().err.splitlines()
    assert lines[0] == f"{WHERE}1 of 3 trials, about 36 s left"
    assert 2 <= len(lines) <= 5


def test_a_fast_filter_shows_none(monkeypatch, capsys):
    install(monkeypatch)
    run_mine()
    assert capsys.readouterr().err == ""
