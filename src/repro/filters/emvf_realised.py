"""EMVF with realised indicators in the innovation, as [packet_delays (22)] prints them.

The printed alpha_i(k) is an indicator of the delay, which by Remark 2 the filter does not need;
`emvf` uses the means. This reading sees the delays. The setting `indicator_of` is the step of the
indicator: `k` (as printed, one step before the packet), or `k+1` (of the packet itself).
"""

from types import SimpleNamespace
from typing import Any, NamedTuple

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
    """The EMVF with delays of the step that `indicator_of` names."""
    inner = emvf.build_with(model, settings, realised_delay=lambda seen: seen.delay)
    predicted, degenerate, covariance = inner.predicted, inner.degenerate, inner.covariance
    assert predicted is not None and degenerate is not None and covariance is not None
    printed = settings.indicator_of == "k"

    def init(streams):
        return State(inner.init(streams), np.zeros(len(streams)))

    def step(state, k, seen):
        seen_by_emvf: Any = SimpleNamespace(
            received=seen.received,
            sensor=seen.sensor,
            earlier_sensors=seen.earlier_sensors,
            delay=state.delay if printed else seen.delay,
        )
        return State(inner.step(state.emvf, k, seen_by_emvf), seen.delay)

    return Filter(
        init,
        step,
        mean=lambda state: inner.mean(state.emvf),
        predicted=lambda state, k: predicted(state.emvf, k),
        degenerate=lambda state: degenerate(state.emvf),
        covariance=lambda state, components: covariance(state.emvf, components),
    )
