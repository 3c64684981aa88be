"""How a filter under development ranks in a study: in memory, on a few trials, in seconds."""

from typing import Any

import numpy as np
import pandas as pd

from repro import plugins
from repro.errors import ReproError
from repro.inspect.interface import paper_of
from repro.parameters.load import Point
from repro.parameters.point_names import on_request
from repro.runner import run
from repro.simulate import simulated
from repro.statistics.shards import Columns
from repro.tables.ranking import rank_rows, ranked
from repro.workflow.memory_and_disk import check_memory

COLUMNS = ("filter error mcse relative_to_informed difference difference_mcse verdict lost").split()


def quick_ranking(
    study: str,
    point: str | None,
    filter_: str,
    settings: dict[str, dict[str, Any]],
    seed: int,
    trials: int,
    tolerance: float,
) -> pd.DataFrame:
    """The filter beside the paper's and the references, on a point or on the first family's points.

    `settings` are those of the filter by point. Raises ReproError if there is no such point.
    """
    paper, scenario = paper_of(study), plugins.study(study)
    ranking = paper.ranking[study]
    analysis = scenario.Analysis.checked(paper.analysis[study], f"{study}: analysis")
    rivals = [*ranking.papers, ranking.informed, ranking.nothing]
    names = list(dict.fromkeys(name for name in (filter_, *rivals) if name))
    tables = []
    for name, at in _chosen(paper.studies[study], study, point).items():
        parameters = at.with_trials(trials).parameters
        check_memory(study, name, parameters)
        log = simulated(study, name, parameters, seed, np.arange(trials))
        found = {}
        for rival in names:
            own = settings.get(name, {}) if rival == filter_ else at.filters.get(rival, {})
            _, runs = run(log, rival, own)
            lost = scenario.lost(runs, analysis)
            share = np.nan if lost is None else float(lost.mean())
            squared = Columns(iter([scenario.squared_error(runs)]), [trials])
            found[rival] = ranked(squared, share)
        table = pd.DataFrame(rank_rows(found, ranking, [filter_], tolerance))
        tables.append(table.assign(point=name))
    return pd.DataFrame(pd.concat(tables).set_index("point")[COLUMNS])


def _chosen(points: dict[str, Point], study: str, point: str | None) -> dict[str, Point]:
    """The named point, or those of the first family."""
    if point is not None:
        if point not in points:
            raise ReproError(f"{study}: no point '{point}'; the points are {', '.join(points)}")
        return {point: points[point]}
    first = next(iter(points.values())).family
    return {n: at for n, at in points.items() if at.family == first and not on_request(n)}
