"""The files under results/, read for the tables, claims, figures and views."""

import itertools
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.lib.npyio import NpzFile

from repro import plugins
from repro.layout import Catalogue, Layout
from repro.logs import Log, read_log
from repro.statistics.runs import Runs
from repro.statistics.shards import Shards, merged


class Results:
    """Logs, runs and tables by name, all shards together."""

    def __init__(
        self,
        root: str | Path,
        catalogue: Catalogue,
        shards: int,
        analysis: Mapping[str, Mapping[str, Any]],
        tolerance: float,
    ):
        """`shards` is the number of each point's; `analysis` holds the thresholds of each study.

        `tolerance` is that of the verdicts, in standard errors.
        """
        self.layout, self.catalogue, self.shards = Layout(root), catalogue, range(shards)
        self.tolerance = tolerance
        self._analysis = analysis

    def analysis(self, study: str) -> Any:
        """The thresholds of a study's metrics and claims, of the study's type `Analysis`."""
        model = plugins.study(study).Analysis
        return model.checked(self._analysis.get(study, {}), f"{study}: analysis")

    def filters(self, study: str, point: str) -> list[str]:
        """Filters that run on a point, in the order of the catalogue of rules."""
        return self.catalogue[study][point]

    def log(self, study: str, point: str) -> Log:
        """The log of a point."""
        return self._log([self.layout.log(study, point, shard) for shard in self.shards])

    def flight(self, study: str, point: str, filter_: str) -> Log:
        """The log of what was flown on a filter's estimates, in a closed loop."""
        return self._log([self.layout.flight(study, point, filter_, s) for s in self.shards])

    def parameters(self, study: str, point: str) -> Any:
        """The parameters of a point as its log has them, of the study's type `Parameters`."""
        return read_log(self.layout.log(study, point, 0)).parameters

    def each_log(self, study: str, point: str, quantity: Callable[[Log], np.ndarray]) -> np.ndarray:
        """A quantity of all trials of a log, from one of a shard's, (trials, ...)."""
        logs = (read_log(self.layout.log(study, point, shard)) for shard in self.shards)
        return np.concatenate([quantity(log) for log in logs])

    def _log(self, files: list[str]) -> Log:
        first, *others = files
        log = read_log(first)
        if not others:
            return log
        trials = [log.trials, *(read_log(other).trials for other in others)]
        values = {
            topic: merged(
                itertools.chain([values], (read_log(other).values[topic] for other in others))
            )
            for topic, values in log.values.items()
        }
        return log._replace(trials=np.concatenate(trials), values=values)

    def each(
        self, study: str, point: str, filter_: str, quantity: Callable[[Runs], np.ndarray]
    ) -> Any:
        """A quantity of all trials of a filter, an array or Columns: see `Shards.each`."""
        return self.in_shards(study, point, filter_).each(quantity)

    def runs(self, study: str, point: str, filter_: str) -> Runs:
        """The runs of a filter on a point, to look at single trials; for statistics use `each`."""
        shards = self.in_shards(study, point, filter_)
        claimed = shards.first.claimed
        if claimed is not None and claimed.ndim == 3:  # else it is the same in every trial
            claimed = merged(part.claimed for part in shards if part.claimed is not None)
        return Runs(
            error=merged(part.error for part in shards),
            claimed=claimed,
            degenerate=merged(part.degenerate for part in shards),
            recorded={
                name: merged(part.recorded[name] for part in shards)
                for name in shards.first.recorded
            },
        )

    def in_shards(self, study: str, point: str, filter_: str) -> Shards:
        """The runs of a filter on a point, one shard at a time in memory."""
        return Shards(
            [partial(self._shard, study, point, filter_, shard) for shard in self.shards],
            [len(self._file(study, point, filter_, shard)["trials"]) for shard in self.shards],
        )

    def _file(self, study: str, point: str, filter_: str, shard: int) -> NpzFile:
        return np.load(self.layout.run(study, point, filter_, shard))

    def _shard(self, study: str, point: str, filter_: str, shard: int) -> Runs:
        part = self._file(study, point, filter_, shard)
        names = [name for name in part.files if name.startswith("recorded_")]
        return Runs(
            error=part["error"],
            claimed=part.get("claimed"),
            degenerate=part["degenerate"],
            recorded={name.removeprefix("recorded_"): part[name] for name in names},
        )

    def table(self, study: str) -> pd.DataFrame:
        """The table of a study, in long form."""
        return pd.read_csv(self.layout.table(study))

    def curves(self, study: str) -> pd.DataFrame:
        """The curves over k of a study, in long form."""
        return pd.read_csv(self.layout.curves(study))

    def diff(self) -> pd.DataFrame:
        """Published values and claims of all papers beside ours, with their verdicts."""
        return pd.read_csv(self.layout.page("diff.csv"))

    def claims(self, paper: str) -> pd.DataFrame:
        """Every comparison that the claims of a paper are made of."""
        return pd.read_csv(self.layout.claims(paper))
