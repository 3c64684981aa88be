"""The filters: one file each, named as in its paper; kernels shared by several begin with _.

A filter module gives LABEL (its name in tables and figures), SEES (the channels it may see) and
`build(model, settings) -> Filter`. It is batched: every array has a leading axis of trials. It may
give STREAM, the name of its random streams (default: its own); filters that share one are paired.
"""

from collections.abc import Callable
from typing import NamedTuple


class Filter(NamedTuple):
    """A filter as pure functions of a state that only the filter itself looks into."""

    init: Callable  # (streams) -> state before the first measurement; len(streams) trials
    step: Callable  # (state, k, seen) -> state; seen.<channel> for each declared channel
    mean: Callable  # (state) -> estimate xh(k|k), (trials, n)
    predicted: Callable | None = None  # (state, k) -> xh(k|k-1) before step k, for scheduling
    variance: Callable | None = None  # (state) -> claimed error variances, (n,) or (trials, n)
    degenerate: Callable | None = None  # (state) -> guarded updates so far, (trials,)
    diagnostics: Callable | None = None  # (state) -> {name: (trials,)} of this step, for the tables
    arrived: Callable | None = None  # (state) -> Pr(gamma(k) = 1) as inferred or known, (trials,)
    particles: int = 1  # systems a trial has, by which the runner sizes its blocks of trials
