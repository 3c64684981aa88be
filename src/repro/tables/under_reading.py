"""The results of a study as they are where the paper is read in another way."""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import pandas as pd

from repro.logs import Log
from repro.statistics.metrics import Jackknife
from repro.statistics.runs import Runs
from repro.statistics.shards import Shards
from repro.tables.results import Results


class NotRunError(LookupError):
    """A claim asks for a point that does not run under the reading."""


class _Points(dict[str, list[str]]):
    """Filters by point, of the points that run under a reading."""

    def __missing__(self, point: str) -> list[str]:
        raise NotRunError(point)


class UnderReading(Results):
    """Results in which each point that is read anew stands for what it is then.

    `used` has the studies, points and filters of the reading that have been asked for, and the
    number of their trials; `parameters_used` the studies and points whose parameters have been.
    """

    def __init__(self, results: Results, points: Mapping[str, Mapping[str, str]]):
        """`points` gives by study, for each point that the reading is of, the one read so."""
        vars(self).update(vars(results))
        self._rmse = {}  # of the points as they are read here
        self._points = points
        self.used: dict[tuple[str, str, str], int] = {}
        self.parameters_used: set[tuple[str, str]] = set()
        self.catalogue = dict(results.catalogue)
        for study, of_study in points.items():
            ran = results.catalogue[study]
            read = {point: ran[as_read] for point, as_read in of_study.items() if as_read in ran}
            self.catalogue[study] = _Points(read)

    def in_shards(self, study: str, point: str, filter_: str) -> Shards:
        """The runs of a filter on a point, as it is read."""
        shards = super().in_shards(study, self._as_read(study, point, filter_), filter_)
        if study in self._points:
            self.used[study, point, filter_] = shards.trials
        return shards

    def rmse(
        self,
        study: str,
        point: str,
        filter_: str,
        squared: Callable[[Runs], np.ndarray],
        average: bool,
    ) -> Jackknife:
        """An RMSE of a filter on a point, as it is read; one that is kept is used as well."""
        number = super().rmse(study, point, filter_, squared, average)
        if study in self._points:
            self.used[study, point, filter_] = len(number.left_out)
        return number

    def table(self, study: str) -> pd.DataFrame:
        """The table of a study; its points as they are read."""
        table = super().table(study)
        if study not in self._points:
            return table
        names = {as_read: point for point, as_read in self._points[study].items()}
        of_reading = table.loc[table["point"].isin(list(names))]
        return of_reading.assign(point=[names[point] for point in of_reading["point"]])

    def parameters(self, study: str, point: str) -> Any:
        """The parameters of a point, as it is read."""
        parameters = super().parameters(study, self._as_read(study, point))
        if study in self._points:
            self.parameters_used.add((study, point))
        return parameters

    def _shard_of_log(self, study: str, point: str, shard: int) -> Log:
        log = super()._shard_of_log(study, self._as_read(study, point), shard)
        if study in self._points:
            self.used[study, point, ""] = len(log.trials)
        return log

    def _as_read(self, study: str, point: str, filter_: str | None = None) -> str:
        if study not in self._points:
            return point
        if filter_ not in (None, *self.catalogue[study][point]):
            raise NotRunError(f"{point}, {filter_}")
        return self._points[study][point]
