"""Whether the filters' own covariances are true, in long form: NEES, NIS, coverage, claimed error.

NEES is e' P^-1 e / d of an error of d components, NIS e' S^-1 e / m of an innovation: of a filter
whose covariance is true both have the mean 1 (Bar-Shalom, Li, Kirubarajan 2001, Sec. 5.4).
"""

from collections.abc import Callable, Iterator
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from repro import plugins
from repro.kernels import chi_square
from repro.statistics.consistency import INNOVATION, Ratio, claimed, normalised, over_all, over_k
from repro.statistics.runs import Runs
from repro.statistics.shards import Shards
from repro.studies import Study
from repro.tables.csv_file import write_csv
from repro.tables.results import Results

SHOWN_STEPS = 200  # of a curve over k, at most
COVERAGES = (0.5, 0.95)
MOST_FREEDOM = 1e6  # beyond it the bounds are within half a percent of one
WIDEST = 2.0  # ratio of the bounds of a mean square that still show a covariance to be true
Quantity = Callable[[Runs], np.ndarray]


def tabulate(results: Results, study: str, path: str) -> list[dict[str, Any]]:
    """Write the table of a study; returns its rows over all steps.

    Bounds are those of a filter whose covariance is true, at as many standard errors as the
    verdicts tolerate. Of one step they are the chi-square's of independent trials; over all steps,
    whose errors are correlated, the chi-square's with the degrees of freedom that the spread over
    the trials shows (Satterthwaite 1946).
    """
    rows, curves = [], []
    for point in results.consistency(study):
        for filter_ in results.filters(study, point):
            shards = results.in_shards(study, point, filter_)
            where = {"study": study, "point": point, "filter": filter_}
            for found in _of_filter(plugins.study(study), shards, results, study, point):
                over_steps = found.pop("over_k")
                rows.append(where | found)
                if over_steps is not None:
                    curves.append(_curve(where | found, *over_steps))
    frame = pd.DataFrame(rows, columns=["study", "point", "filter", *COLUMNS])
    write_csv(pd.concat([frame, *curves]) if curves else frame, path)
    return rows


class Expected(NamedTuple):
    """A statistic of a filter whose covariance is true."""

    value: float
    freedom: int = 0  # degrees of freedom of a trial and step; 0: no curve over k
    falls: bool = False  # whether a covariance that is too small makes it smaller


COLUMNS = ("component", "metric", "k", "value", "mcse", "lower", "upper", "verdict", "trials")


def _of_filter(
    scenario: Study, shards: Shards, results: Results, study: str, point: str
) -> Iterator[dict[str, Any]]:
    """Rows of one filter, each with its curve over k."""
    tolerance, kept = results.tolerance, shards.first.recorded
    for group, components in scenario.judged_components.items():
        nees = normalised(group)
        if nees not in kept:
            continue
        d = len(components)

        def inside(runs: Runs, nees: str = nees) -> np.ndarray:
            return scenario.counted(runs) & np.isfinite(runs.recorded[nees])

        def squared(runs: Runs, components: Any = tuple(components)) -> np.ndarray:
            return np.where(scenario.counted(runs), _squares(runs, components), 0.0)

        def claims(runs: Runs, group: str = group) -> np.ndarray:
            return np.where(scenario.counted(runs), runs.recorded[claimed(group)], 0.0)

        def errors(runs: Runs, nees: str = nees) -> np.ndarray:
            return np.where(inside(runs), runs.recorded[nees], 0.0)

        yield _row(group, "nees", (shards, errors, inside), Expected(1.0, d), tolerance)
        of = shards, claims, squared
        yield _row(group, "claimed_over_true", of, Expected(1.0, falls=True), tolerance)
        for share in COVERAGES:
            largest = chi_square.quantile(share, float(d)) / d

            def covered(runs: Runs, nees: str = nees, largest: float = largest) -> np.ndarray:
                return scenario.counted(runs) & (runs.recorded[nees] <= largest)

            of, expected = (shards, covered, scenario.counted), Expected(share, falls=True)
            yield _row(group, f"coverage_{share * 100:g}", of, expected, tolerance)
        of = shards, _collapsed(scenario, nees), scenario.counted
        yield _row(group, "collapsed", of, None, tolerance)
    if INNOVATION in kept:
        used = _used(scenario)
        m = len(plugins.study(study).model(results.parameters(study, point)).measurement_covariance)
        yield _row("measurement", "nis", (shards, _innovation, used), Expected(1.0, m), tolerance)


def chi_square_bounds(freedom: float, tolerance: float) -> tuple[float, float]:
    """Of a mean of so many squares of standard normals, at a tolerance in standard errors."""
    outside = 0.5 * (1.0 - chi_square.probability_below(tolerance * tolerance, 1.0))
    low, high = (chi_square.quantile(p, float(freedom)) for p in (outside, 1.0 - outside))
    return low / freedom, high / freedom


def _collapsed(scenario: Study, nees: str) -> Quantity:
    """Where a filter claims no error in a direction in which there is one."""
    return lambda runs: scenario.counted(runs) & np.isinf(runs.recorded[nees])


def _used(scenario: Study) -> Quantity:
    """Where a filter uses the measurement."""
    return lambda runs: scenario.counted(runs) & np.isfinite(runs.recorded[INNOVATION])


def _innovation(runs: Runs) -> np.ndarray:
    return np.nan_to_num(runs.recorded[INNOVATION])


def _squares(runs: Runs, components: tuple[int, ...]) -> np.ndarray:
    """Squared error summed over components, (trials, steps)."""
    return sum((runs.error[..., i] ** 2 for i in components), np.zeros(runs.error.shape[:2]))


def _row(
    component: str,
    metric: str,
    of: tuple[Shards, Quantity, Quantity],
    expected: Expected | None,
    tolerance: float,
) -> dict[str, Any]:
    """A row: the ratio of the means of two quantities beside what it should be."""
    shards, above, below = of
    numerator, denominator = (
        shards.each(lambda runs, f=f: f(runs).astype(float)) for f in (above, below)
    )
    mean, curve = over_all(numerator, denominator), None
    lower, upper = bounds(mean, expected, tolerance) if expected else (np.nan, np.nan)
    if expected and expected.freedom:
        limits = chi_square_bounds(shards.trials * expected.freedom, tolerance)
        curve = over_k(numerator, denominator), limits
    return {
        "component": component,
        "metric": metric,
        "k": np.nan,
        "value": float(mean.value),
        "mcse": float(mean.mcse),
        "lower": lower,
        "upper": upper,
        "verdict": verdict(float(mean.value), lower, upper, expected) if expected else "",
        "trials": shards.trials,
        "over_k": curve,
    }


def bounds(mean: Ratio, expected: Expected, tolerance: float) -> tuple[float, float]:
    """Between which the statistic is if the covariance is true; NaN if one trial cannot tell."""
    value, mcse = float(mean.value), float(mean.mcse)
    if not np.isfinite(mcse):
        return np.nan, np.nan
    if expected.value != 1.0:  # a share
        margin = tolerance * mcse
        return max(expected.value - margin, 0.0), min(expected.value + margin, 1.0)
    if mcse == 0.0:
        return 1.0, 1.0
    freedom = min(2.0 * (value / mcse) ** 2, MOST_FREEDOM)
    low, high = chi_square_bounds(freedom, tolerance)
    return (1.0 / high, 1.0 / low) if expected.falls else (low, high)


def verdict(value: float, lower: float, upper: float, expected: Expected) -> str:
    """Whether a covariance is true by one of its statistics.

    `overconfident`: it is too small; `cautious`: it is too large; `undecided` if the bounds are too
    wide to say that it is true.
    """
    if np.isnan(lower):
        return "undecided"
    if value < lower or value > upper:
        return "overconfident" if (value > expected.value) != expected.falls else "cautious"
    decisive = expected.value != 1.0 or upper < WIDEST * lower
    return "consistent" if decisive else "undecided"


def _curve(row: dict[str, Any], over_steps: Ratio, limits: tuple[float, float]) -> pd.DataFrame:
    """The same at some of the steps."""
    steps = len(np.asarray(over_steps.value))
    k = np.unique(np.linspace(1, steps - 1, min(steps - 1, SHOWN_STEPS)).round().astype(int))
    values, errors = np.asarray(over_steps.value), np.asarray(over_steps.mcse)
    of_steps = {"k": k, "value": values[k], "mcse": errors[k], "verdict": ""}
    return pd.DataFrame(row | of_steps | {"lower": limits[0], "upper": limits[1]})
