"""What a mean over the runs hides: lost runs, quantiles, the weight of the worst runs."""

import math
from collections.abc import Iterator

import numpy as np

from repro import plugins
from repro.parameters.point_names import is_plain
from repro.statistics import metrics
from repro.statistics.shards import Columns
from repro.tables.csv_file import write_csv
from repro.tables.results import Results

WORST = 0.05  # share of the runs
QUANTILES = (0.05, 0.5, 0.95, 0.99)

Entry = tuple[str, float, float]  # metric, value, its Monte Carlo standard error


def write_tails(results: Results, study: str, path: str) -> None:
    """Write the tails of the errors of every filter on the paper's own points of a study."""
    scenario, analysis = plugins.study(study), results.analysis(study)
    rows = []
    for point in filter(is_plain, results.points(study)):
        for filter_ in results.filters(study, point):
            shards = results.in_shards(study, point, filter_)
            lost = shards.each(lambda runs: np.asarray(scenario.lost(runs, analysis)))
            squared = shards.each(scenario.squared_error)
            where = {"study": study, "point": point, "filter": filter_, "trials": len(lost)}
            rows += [
                where | {"metric": metric, "value": value, "mcse": mcse}
                for metric, value, mcse in entries(run_errors(squared), lost)
            ]
    write_csv(rows, path)


def run_errors(squared: Columns) -> np.ndarray:
    """The error of each run: mean over k of its error, (trials,), from the squared errors."""
    total = np.zeros(squared.trials)
    for block in squared.blocks():
        for of_step in block:
            total += np.sqrt(of_step)
    return total / squared.steps


def entries(errors: np.ndarray, lost: np.ndarray) -> Iterator[Entry]:
    """The numbers of a filter on a point, from the error of each run and whether it is lost.

    The error of a quantile is half the distance of the quantiles one standard deviation of the
    empirical distribution function above and below. `worst_share` is the part of the mean that
    the worst 5 % of the runs make up, `worst_share_of_squares` that of the mean of the squares.
    """
    trials, kept = len(errors), errors[~lost]
    share = float(lost.mean())
    yield "lost", share, math.sqrt(share * (1.0 - share) / trials)
    yield "mean", float(errors.mean()), float(metrics.mean_error(errors))
    if len(kept):
        yield "mean_not_lost", float(kept.mean()), float(metrics.mean_error(kept))
    ascending = np.sort(errors)
    for p in QUANTILES:
        away = math.sqrt(p * (1.0 - p) / trials)
        below, at, above = np.quantile(ascending, np.clip([p - away, p, p + away], 0.0, 1.0))
        yield f"q{100 * p:02.0f}", float(at), float(above - below) / 2.0
    yield "worst_share", *worst_share(ascending)
    yield "worst_share_of_squares", *worst_share(ascending**2)


def worst_share(ascending: np.ndarray) -> tuple[float, float]:
    """Part of the sum that the worst runs make up, and its jackknife error."""
    worst = max(1, round(WORST * len(ascending)))
    if len(ascending) <= worst:
        return 1.0, math.nan
    of_worst, total = ascending[-worst:].sum(), ascending.sum()
    if total == 0.0:  # a filter that starts on the truth and needs no data
        return math.nan, math.nan
    # Without one of the worst runs the best of the others is one of them.
    left = np.full(len(ascending), of_worst)
    left[-worst:] += ascending[-worst - 1] - ascending[-worst:]
    left_out = left / (total - ascending)
    return float(of_worst / total), float(metrics.jackknife_error(left_out))
