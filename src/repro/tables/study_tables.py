"""Tables and curves of a study, in long form, each number with its Monte Carlo standard error."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd

from repro import plugins
from repro.statistics.shards import Shards
from repro.studies import Study
from repro.tables.csv_file import write_csv
from repro.tables.ranking import Rankings
from repro.tables.results import Results


def tabulate(results: Results, study: str, table: str, curves: str, ranking: Sequence[str]) -> None:
    """Write the table and the curves of every point and filter of a study, and its ranking.

    `ranking` are the files of `Rankings.write`: all of them come of one reading of the runs.
    """
    scenario, analysis = plugins.study(study), results.analysis(study)
    rankings = Rankings(results, study)
    rows, over_k = [], []
    for point, filters in results.catalogue[study].items():
        for filter_ in filters:
            shards = results.in_shards(study, point, filter_)
            degenerate = shards.each(lambda runs: runs.degenerate).mean()
            lost = share_lost(scenario, analysis, shards)
            where = {"study": study, "point": point, "filter": filter_}
            for metric, component, statistic in scenario.rows(shards, analysis):
                rows.append(
                    where
                    | {"metric": metric, "component": component}
                    | {"value": statistic.value, "mcse": statistic.mcse}
                    | {"trials": shards.trials, "median": statistic.median}
                    | {"q10": statistic.q10, "q90": statistic.q90}
                    | {"lost": lost, "degenerate": degenerate}
                )
            for metric, component, statistic in scenario.curves(shards):
                over_k.append(
                    pd.DataFrame(
                        where
                        | {"metric": metric, "component": component}
                        | {"k": np.arange(len(statistic.value)), "value": statistic.value}
                        | {"mcse": statistic.mcse, "median": statistic.median}
                        | {"q10": statistic.q10, "q90": statistic.q90}
                    )
                )
            rankings.add(point, filter_, shards, lost)
        rankings.rank(point)
    write_csv(rows, table)
    write_csv(pd.concat(over_k), curves)
    rankings.write(*ranking)


def share_lost(study: Study, analysis: Any, shards: Shards) -> float:
    """Share of the runs that lost their target; NaN where a study has none to lose."""
    if study.lost(shards.first, analysis) is None:
        return np.nan
    return shards.each(lambda runs: np.asarray(study.lost(runs, analysis))).mean()
