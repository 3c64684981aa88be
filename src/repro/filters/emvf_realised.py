"""EMVF with realised indicators in the innovation, as (22) prints them (Liu, Xu, Shi 2012).

The printed alpha_i(k) is an indicator of the delay, which Remark 2 says the filter does not need;
the project's EMVF takes the means. This reading sees the delays. The setting `indicator_of` says
of which step: `k` (as printed, one step before the packet), or `k+1` (of the packet itself).
"""

from types import SimpleNamespace
from typing import NamedTuple

import numpy as np

from repro.filters import Filter, emvf
from repro.models import Model
from repro.parameters.settings import RealisedIndicators

LABEL = "EMVF, realised alpha"
SEES = ("received", "delay")


class State(NamedTuple):
    emvf: emvf.State
    delay: np.ndarray  # D of the step before, (trials,)


def build(model: Model, settings: RealisedIndicators) -> Filter:
    inner = emvf.build_with(model, settings, realised_delay=lambda seen: seen.delay)
    printed = settings.indicator_of == "k"

    def init(streams):
        return State(inner.init(streams), np.zeros(len(streams)))

    def step(state, k, seen):
        told = SimpleNamespace(
            received=seen.received,
            sensor=seen.sensor,
            earlier_sensors=seen.earlier_sensors,
            delay=state.delay if printed else seen.delay,
        )
        return State(inner.step(state.emvf, k, told), seen.delay)

    return Filter(
        init,
        step,
        mean=lambda state: inner.mean(state.emvf),
        predicted=lambda state, k: inner.predicted(state.emvf, k),
        degenerate=lambda state: inner.degenerate(state.emvf),
    )
