"""The filters: one file each, named as in its paper; `families` holds what several share.

A filter module gives LABEL (its name in tables and figures), SEES (the channels it may see) and
`build(model, settings) -> Filter`. It is batched: every array has a leading axis of trials. It may
give STREAM, the name of its random streams (default: its own); filters that share one are paired.
"""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from repro.network.channels import Seen
from repro.streams import Streams

State = Any  # whatever the filter keeps from step to step

Init = Callable[[Streams], State]  # state before the first measurement, of len(streams) trials
Step = Callable[[State, int, Seen], State]  # (state, k, seen); seen.<channel> for each declared
OfState = Callable[[State], np.ndarray]
OfStateAndStep = Callable[[State, int], np.ndarray]
OfStateAndComponents = Callable[[State, Sequence[int]], np.ndarray]
Diagnostics = Callable[[State], dict[str, np.ndarray]]


class Filter(NamedTuple):
    """A filter as pure functions of a state that only the filter itself looks into."""

    init: Init
    step: Step
    mean: OfState  # estimate xh(k|k), (trials, n)
    predicted: OfStateAndStep | None = None  # xh(k|k-1) before step k, for scheduling
    variance: OfState | None = None  # claimed error variances, (n,) or (trials, n)
    degenerate: OfState | None = None  # guarded updates so far, (trials,)
    diagnostics: Diagnostics | None = None  # {name: (trials,)} of this step, for the tables
    arrived: OfState | None = None  # Pr(gamma(k) = 1) as inferred or known, (trials,)
    # Claimed error covariance of some components of the state, (d, d) or (trials, d, d)
    covariance: OfStateAndComponents | None = None
    # e' S^-1 e / m of the innovation of this step, (trials,); NaN where no measurement was used
    normalised_innovation: OfState | None = None
    particles: int = 1  # systems a trial has, by which the runner sizes its blocks of trials
