"""Which of two filters, or of two points, is the more accurate.

An accuracy is compared by the share of runs in which the first has the smaller error and by the
mean over k of RMSE(k). Where there is a target to lose, that mean is over the runs that neither
filter loses, and the shares of lost runs are compared beside it: one lost run in a thousand sets
the mean over all runs, which would then be decided by the seed.
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
from repro.verdicts.equivalence import equivalent


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
    results: Results,
    study: str,
    first: FilterAt,
    second: FilterAt,
    component: str,
    name: str,
    factor: float = 1.0,
) -> list[Part]:
    """`first` is more accurate, so much that even `factor` times its error is the smaller."""
    errors = [squared(results, study, filter_at, component) for filter_at in (first, second)]
    of_each = [error.mean_over_steps() for error in errors]
    run_by_run = most(f"{name}, run by run", factor**2 * of_each[0] < of_each[1])
    if not isinstance(study_of(study), SignalStrengthStudy):
        return [run_by_run, of_all_runs(results, study, first, second, component, name, factor)]
    analysis = results.analysis(study)
    losses = [lost(results, study, filter_at) for filter_at in (first, second)]
    parts = [run_by_run, no_more_lost(name, losses, analysis.lost_margin)]
    kept = ~np.any(losses, axis=0)
    if kept.sum() < analysis.fewest_compared:
        return [*parts, smaller(f"{name}, share of runs lost", *np.asarray(losses, dtype=float))]
    of_kept = [error.only(kept) for error in errors]
    return [*parts, combination(f"{name}, runs not lost", (factor, -1), of_kept)]


def no_more_lost(name: str, losses: Sequence[np.ndarray], margin: float) -> Part:
    """The first loses no larger share of runs by more than the margin; flags (trials,) each."""
    first, second = losses
    more = first.astype(float) - second
    name = f"{name}, share of runs lost ({first.mean():.3g}, {second.mean():.3g}) - {margin:g}"
    return Part(name, float(more.mean() - margin), float(metrics.mean_error(more)))


def of_all_runs(
    results: Results,
    study: str,
    first: FilterAt,
    second: FilterAt,
    component: str,
    name: str,
    factor: float = 1.0,
) -> Part:
    """`factor` times the RMSE of `first` over all runs, the lost ones with them, is the smaller."""
    errors = [squared(results, study, filter_at, component) for filter_at in (first, second)]
    return combination(f"{name}, all runs", (factor, -1), errors)


def near(
    results: Results, study: str, first: str, second: str, component: str, factor: float
) -> list[Part]:
    """The RMSEs of two filters differ by less than a factor over the runs that neither loses."""
    filters = [FilterAt("base", name) for name in (first, second)]
    losses = [lost(results, study, filter_at) for filter_at in filters]
    kept = ~np.any(losses, axis=0)
    errors = [squared(results, study, filter_at, component).only(kept) for filter_at in filters]
    name = f"{study} {component}: {first} / {second}"
    return [
        no_more_lost(name, losses, results.analysis(study).lost_margin),
        *log_ratio_within(f"{name}, log, runs not lost", errors, factor),
    ]


def log_ratio_within(name: str, errors: Sequence[Columns], factor: float) -> list[Part]:
    """Neither of two mean RMSEs is `factor` times the other; jackknife over their trials."""
    runs = errors[0].trials
    if runs < 2:
        return equivalent(f"{name}: {runs} runs", np.nan, np.nan, np.log(factor))
    first, second = (metrics.roots_over_steps(error) for error in errors)
    error = metrics.jackknife_error(np.log(first.left_out / second.left_out))
    name = f"{name} ({first.value:.3g} / {second.value:.3g}; {runs} runs)"
    return equivalent(name, np.log(first.value / second.value), float(error), np.log(factor))


def best_of(
    results: Results, study: str, first: str, others: Iterable[str], factor: float = 1.0
) -> list[Part]:
    """`factor` times the error of `first` is below each other filter's in every component."""
    return [
        part
        for pair in pairs(study, first, others, factor)
        for part in better(results, study, *pair, factor)
    ]


def pairs(
    study: str, first: str, others: Iterable[str], factor: float = 1.0
) -> list[tuple[FilterAt, FilterAt, str, str]]:
    """`first` with each other filter in every component, and what they are called."""
    times = "" if factor == 1 else f"{factor:g} "
    return [
        (
            FilterAt("base", first),
            FilterAt("base", other),
            component,
            f"{study} {component}: {times}{first} - {other}",
        )
        for component in study_of(study).components
        for other in others
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
