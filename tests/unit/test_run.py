"""Filters that break their contract get one line."""

import sys
from types import ModuleType

import numpy as np
import pytest

from repro.errors import ReproError
from repro.filters import Filter
from repro.runner import run
from tests.conftest import small_log


def install(monkeypatch, step=None, mean=None, sees=("received",)):
    module = ModuleType("repro.filters.mine")
    module.LABEL, module.SEES = "mine", sees
    module.build = lambda model, settings: Filter(
        init=lambda streams: np.zeros((len(streams), 2)),
        step=step or (lambda state, k, seen: state),
        mean=mean or (lambda state: state),
    )
    monkeypatch.setitem(sys.modules, "repro.filters.mine", module)
    return module


def run_mine(name="mine"):
    return run(small_log("linear_delays", "arrival=0.5", 3), name, {})


@pytest.mark.parametrize(
    ("broken", "message"),
    [
        ({"step": lambda state, k, seen: state * np.nan}, "trial 0 at step 1 is not finite"),
        ({"mean": lambda state: state[:, :1]}, r"mean.state. has shape \(3, 1\) at step 0"),
        ({"step": lambda state, k, seen: seen.delay}, "'delay', which its SEES does not declare"),
        ({"sees": ("truth",)}, "SEES names the channel 'truth', which this study does not have"),
    ],
)
def test_a_broken_filter_gets_one_line(broken, message, monkeypatch):
    install(monkeypatch, **broken)
    with pytest.raises(ReproError, match=message) as error:
        run_mine()
    assert "\n" not in str(error.value) and "filter mine" in str(error.value)


def test_a_filter_that_is_not_there_or_lacks_a_name(monkeypatch):
    with pytest.raises(ReproError, match=r"there is no src/repro/filters/nowhere\.py"):
        run_mine("nowhere")
    del install(monkeypatch).LABEL
    with pytest.raises(ReproError, match="defines no LABEL"):
        run_mine()
