"""How the filters of a study rank: errors on the same trials, with paired differences."""

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from repro import plugins
from repro.kernels import arrays
from repro.parameters.paper_file import Ranking
from repro.statistics import metrics
from repro.statistics.metrics import Jackknife
from repro.statistics.paired import decided
from repro.statistics.shards import Columns, Shards
from repro.tables.csv_file import write_csv
from repro.tables.results import Results

SHARES = np.linspace(0.0, 1.0, 101)  # of the runs, at which the distribution of errors is kept


class Ranked(NamedTuple):
    """A filter's error on a point."""

    error: Jackknife  # mean over k of the root of the mean squared error over the trials
    trials: int
    lost: float  # share of the runs that lost their target; NaN where a study knows no such thing


def ranked(squared: Columns, lost: float) -> Ranked:
    """`squared` are the squared errors by which the study ranks, (trials, steps)."""
    return Ranked(metrics.roots_over_steps(squared), squared.trials, lost)


def rank_rows(
    filters: dict[str, Ranked], ranking: Ranking, own: Iterable[str], tolerance: float
) -> Iterable[dict[str, Any]]:
    """One row a filter, the most accurate first.

    Error with its standard error and quantiles over the single runs; relative to the best informed
    reference and to using no measurement; the paired difference to the best of the paper's filters
    (of all others, where the study has no paper) and its verdict.
    """
    rivals = [name for name in filters if name in ranking.papers] or list(filters)
    best = min(rivals, key=lambda name: filters[name].error.value)
    for name, of_filter in sorted(filters.items(), key=lambda item: item[1].error.value):
        statistic = metrics.statistic(of_filter.error)
        difference = of_filter.error.value - filters[best].error.value
        left_out = of_filter.error.left_out - filters[best].error.left_out
        error = float(metrics.jackknife_error(left_out))
        yield {
            "filter": name,
            "whose": _whose(name, ranking, own),
            "error": statistic.value,
            "mcse": statistic.mcse,
            "median": statistic.median,
            "q10": statistic.q10,
            "q90": statistic.q90,
            "trials": of_filter.trials,
            "lost": of_filter.lost,
            "relative_to_informed": _relative(of_filter, filters.get(ranking.informed or "")),
            "relative_to_nothing": _relative(of_filter, filters.get(ranking.nothing or "")),
            "best_of_paper": best,
            "difference": difference,
            "difference_mcse": error,
            "verdict": "reference" if name == best else decided(difference, error, tolerance),
        }


def _whose(name: str, ranking: Ranking, own: Iterable[str]) -> str:
    if name in ranking.papers:
        return "paper"
    return "own" if name in own else "reference"


def _relative(of_filter: Ranked, reference: Ranked | None) -> float:
    """Ratio of the errors; NaN without a reference, or where the reference has no error."""
    if reference is None or reference.error.value == 0.0:
        return np.nan
    return of_filter.error.value / reference.error.value


class Rankings:
    """The ranking of every point of a study, the errors over k, their distribution over the runs.

    Each filter of a point is added, then the point is ranked.
    """

    def __init__(self, results: Results, study: str):
        self._results, self._study, self._scenario = results, study, plugins.study(study)
        self._ranking = results.ranking(study)
        self._filters: dict[str, Ranked] = {}  # of the point whose filters are added
        self._rows: list[dict[str, Any]] = []
        self._curves: list[pd.DataFrame] = []
        self._distributions: list[pd.DataFrame] = []

    def add(self, point: str, filter_: str, shards: Shards, lost: float) -> None:
        """Add the runs of a filter, of which it lost that share."""
        squared = shards.each(self._scenario.squared_error)
        of_filter = self._filters[filter_] = ranked(squared, lost)
        where = {"study": self._study, "point": point, "filter": filter_}
        statistic = metrics.root_mean(squared)
        # The steps that count end with the last; a study may leave out the first.
        k = np.arange(len(statistic.value)) + shards.first.error.shape[1] - len(statistic.value)
        self._curves.append(pd.DataFrame(where | {"k": k} | statistic._asdict()))
        single = np.quantile(of_filter.error.single, SHARES)
        self._distributions.append(pd.DataFrame(where | {"share": SHARES, "error": single}))

    def rank(self, point: str) -> None:
        """Rank the filters that were added."""
        results = self._results
        where = {"study": self._study, "family": results.points(self._study)[point]["family"]}
        self._rows += [
            where | {"point": point} | row
            for row in rank_rows(
                self._filters, self._ranking, results.own_filters, results.tolerance
            )
        ]
        self._filters = {}

    def write(self, table: str, over_k: str, shares: str) -> None:
        """Write what was ranked."""
        write_csv(self._rows, table)
        write_csv(pd.concat(self._curves), over_k)
        write_csv(pd.concat(self._distributions), shares)


def geometric_mean(values: Any) -> float:
    """Of the values that are known; 0 if one of them is 0."""
    known = np.asarray(values, dtype=float)
    known = known[~np.isnan(known)]
    return float(arrays.exp(arrays.log(known).mean())) if len(known) else np.nan
