"""Which of two filters, or of two points, is the more accurate.

An accuracy is compared by the mean over k of RMSE(k), of all runs and of those that neither filter
loses, and by the share of runs in which the first has the smaller error: a few lost runs can
dominate the mean.
"""

from collections.abc import Iterable, Sequence
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from repro.papers.energy_harvesting.compared import PROPOSED, SWEPT_STUDY, Sweep, study_of
from repro.statistics import metrics
from repro.statistics.shards import Columns
from repro.studies.families import harvesting_sensors
from repro.studies.families.signal_strength import SignalStrengthStudy
from repro.tables.results import Results
from repro.verdicts.claims import Part, most, smaller


class FilterAt(NamedTuple):
    """A filter on a point."""

    point: str
    filter: str


def squared(results: Results, study: str, filter_at: FilterAt, component: str) -> Columns:
    """Squared errors of every run at k = 1 ... K."""
    axes = study_of(study).components[component]
    return harvesting_sensors.squared_after_start(results.in_shards(study, *filter_at), axes)


def lost(results: Results, study: str, *filters: FilterAt) -> np.ndarray:
    """Which trials at least one of these loses, (trials,)."""
    scenario, analysis = study_of(study), results.analysis(study)
    each = [
        results.each(study, *f, lambda runs: np.asarray(scenario.lost(runs, analysis)))
        for f in filters
    ]
    return np.any([np.asarray(flags) for flags in each], axis=0)


def combination(name: str, weights: Sequence[float], errors: Sequence[Columns]) -> Part:
    """The weighted sum of mean RMSEs is negative; jackknife over the trials that they share."""
    runs = errors[0].trials
    if runs < 2:
        return Part(f"{name}: {runs} runs", np.nan, np.nan)
    numbers = [metrics.roots_over_steps(error) for error in errors]
    weighted = list(zip(weights, numbers, strict=True))
    left_out = np.sum([weight * number.left_out for weight, number in weighted], axis=0)
    return Part(
        f"{name} ({', '.join(f'{number.value:.3g}' for number in numbers)}; {runs} runs)",
        float(np.sum([weight * number.value for weight, number in weighted])),
        float(metrics.jackknife_error(left_out)),
    )


def better(
    results: Results, study: str, first: FilterAt, second: FilterAt, component: str, name: str
) -> list[Part]:
    """`first` is more accurate: over all runs, in most runs, and over the runs not lost."""
    errors = [squared(results, study, filter_at, component) for filter_at in (first, second)]
    parts = [
        combination(f"{name}, all runs", (1, -1), errors),
        most(f"{name}, run by run", np.less(*(error.mean_over_steps() for error in errors))),
    ]
    if not isinstance(study_of(study), SignalStrengthStudy):
        return parts  # there is no target to lose
    kept = ~lost(results, study, first, second)
    if kept.sum() < results.analysis(study).fewest_compared:
        losses = (lost(results, study, filter_at).astype(float) for filter_at in (first, second))
        return [*parts, smaller(f"{name}, share of runs lost", *losses)]
    of_kept = [error.only(kept) for error in errors]
    return [*parts, combination(f"{name}, runs not lost", (1, -1), of_kept)]


def best_of(results: Results, study: str, first: str, others: Iterable[str]) -> list[Part]:
    """The filter `first` is more accurate than each of the others in every component."""
    return [
        part
        for component in study_of(study).components
        for other in others
        for part in better(
            results,
            study,
            FilterAt("base", first),
            FilterAt("base", other),
            component,
            f"{study} {component}: {first} - {other}",
        )
    ]


def ordered(results: Results, sweep: Sweep, rising: bool = True) -> list[Part]:
    """The errors of PF-ROSS-EH rise along the sweep, or fall, in position and velocity."""
    points = sweep.points if rising else sweep.points[::-1]
    values = sweep.values(results)
    return [
        part
        for component in study_of(SWEPT_STUDY).components
        for low, high in pairwise(points)
        for part in better(
            results,
            SWEPT_STUDY,
            FilterAt(low, PROPOSED),
            FilterAt(high, PROPOSED),
            component,
            f"{component}: {sweep.parameter} {values[low]} - {values[high]}",
        )
    ]
