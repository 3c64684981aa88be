"""The files under results/, read for the tables, claims, figures and views."""

import itertools
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import lru_cache, partial
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from repro import plugins
from repro.layout import Catalogue, Layout
from repro.logs import Log, read_log, read_parameters
from repro.origin import of_shard, origin
from repro.parameters.paper_file import Ranking
from repro.parameters.point_names import batch_of
from repro.statistics import metrics
from repro.statistics.metrics import Jackknife
from repro.statistics.runs import Runs, read_runs, read_trials
from repro.statistics.shards import Shards, merged

# Study -> point -> "trials", "log_of" (the point whose log it reads), "log" (digest of what that is
# made with), "filters" (of runs).
Origins = Mapping[str, Mapping[str, Mapping[str, Any]]]


class Results:
    """Logs, runs and tables by name, all shards together."""

    def __init__(
        self,
        root: str | Path,
        catalogue: Catalogue,
        shards: int,
        studies: Mapping[str, Mapping[str, Any]],
        own_filters: Sequence[str],
        tolerance: float,
        origins: Origins | None = None,
    ):
        """`shards` is the number of each point's.

        `studies` has for each study what `Paper.described` gives; `own_filters` are the filters
        that no parameter file ranks, a reader's own, in the order of their rules; `tolerance` is
        that of the verdicts, in standard errors. Logs and runs that are not of the `origins` are
        refused with a ReproError; None takes any.
        """
        self._origins = origins
        self.layout, self.catalogue, self.shards = Layout(root), catalogue, range(shards)
        self.tolerance, self.own_filters = tolerance, own_filters
        self._studies = studies
        self._rmse: dict[tuple, Jackknife] = {}
        self._read_log = lru_cache(maxsize=1)(read_log)  # one figure after the other asks for it

    def analysis(self, study: str) -> Any:
        """The thresholds of a study's metrics and claims, of the study's type `Analysis`."""
        model = plugins.study(study).Analysis
        return model.checked(self._studies[study]["analysis"], f"{study}: analysis")

    def ranking(self, study: str) -> Ranking:
        """Which filters of a study are the paper's, and which measure them."""
        return Ranking.checked(self._studies[study]["ranking"], f"{study}: ranking")

    def consistency(self, study: str) -> list[str]:
        """The points at which the filters' own covariances are judged, as far as they run."""
        judged = self._studies[study]["consistency"]
        return [point for point in judged if point in self.catalogue[study]]

    def points(self, study: str) -> dict[str, dict[str, Any]]:
        """`family` and `swept` values of the points on which filters run, by name."""
        of_study = self._studies[study]["points"]
        return {point: of_study[point] for point in self.catalogue[study]}

    def and_own(self, study: str, point: str, names: Iterable[str]) -> list[str]:
        """Filters that a figure names, and a reader's own, as far as they run on the point."""
        return [f for f in (*names, *self.own_filters) if f in self.filters(study, point)]

    def filters(self, study: str, point: str) -> list[str]:
        """Filters that run on a point, in the order of the catalogue of rules."""
        return self.catalogue[study][point]

    def log(self, study: str, point: str) -> Log:
        """The log of a point."""
        log, others = self._shard_of_log(study, point, 0), self.shards[1:]
        if not others:
            return log

        def each(topic: str) -> Iterator[np.ndarray]:
            for shard in others:
                yield self._shard_of_log(study, point, shard).values[topic]

        trials = [log.trials, *(self._shard_of_log(study, point, s).trials for s in others)]
        values = {
            topic: merged(itertools.chain([values], each(topic)))
            for topic, values in log.values.items()
        }
        return log._replace(trials=np.concatenate(trials), values=values)

    def parameters(self, study: str, point: str) -> Any:
        """The parameters of a point as its log has them, of the study's type `Parameters`."""
        expected = self._expected(study, point, 0)
        return read_parameters(self._log_file(study, point, 0), expected)

    def each_log(self, study: str, point: str, quantity: Callable[[Log], np.ndarray]) -> np.ndarray:
        """A quantity of all trials of a log, from one of a shard's, (trials, ...)."""
        logs = (self._shard_of_log(study, point, shard) for shard in self.shards)
        return np.concatenate([quantity(log) for log in logs])

    def _shard_of_log(self, study: str, point: str, shard: int) -> Log:
        expected = self._expected(study, point, shard)
        log = self._read_log(self._log_file(study, point, shard), origin=expected)
        return log._replace(point=point)

    def log_of(self, study: str, point: str) -> str:
        """The point whose log a point reads, which may be another with the same values."""
        return self._origins[study][point]["log_of"] if self._origins else point

    def _log_file(self, study: str, point: str, shard: int) -> str:
        return self.layout.log(study, self.log_of(study, point), shard)

    def each(
        self, study: str, point: str, filter_: str, quantity: Callable[[Runs], np.ndarray]
    ) -> Any:
        """A quantity of all trials of a filter, an array or Columns: see `Shards.each`."""
        return self.in_shards(study, point, filter_).each(quantity)

    def rmse(
        self,
        study: str,
        point: str,
        filter_: str,
        squared: Callable[[Runs], np.ndarray],
        average: bool,
    ) -> Jackknife:
        """`roots_over_steps` of the squared errors; kept, as claims compare each with many."""
        key = study, point, filter_, squared, average
        if key not in self._rmse:
            of_steps = self.each(study, point, filter_, squared)
            self._rmse[key] = metrics.roots_over_steps(of_steps, average)
        return self._rmse[key]

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
            [read_trials(self._file(study, point, filter_, s), point) for s in self.shards],
        )

    def _file(self, study: str, point: str, filter_: str, shard: int) -> str:
        return self.layout.run(study, batch_of(point), filter_, shard)

    def _shard(self, study: str, point: str, filter_: str, shard: int) -> Runs:
        expected = self._expected(study, point, shard, filter_)
        return read_runs(self._file(study, point, filter_, shard), point, expected)

    def _expected(self, study: str, point: str, shard: int, filter_: str = "") -> str | None:
        """The origin of a log, or of a filter's runs on it."""
        if self._origins is None:
            return None
        of_point = self._origins[study][point]
        trials = of_shard(of_point["trials"], shard, len(self.shards))
        return origin(of_point["filters"][filter_] if filter_ else of_point["log"], trials)

    def table(self, study: str) -> pd.DataFrame:
        """The table of a study, in long form."""
        return pd.read_csv(self.layout.table(study))

    def tails(self, study: str) -> pd.DataFrame:
        """What the means of a study hide."""
        return pd.read_csv(self.layout.tails(study))

    def convergence(self, study: str) -> pd.DataFrame:
        """The errors of a study over the number of particles."""
        return pd.read_csv(self.layout.convergence(study))

    def mismatch(self, study: str) -> pd.DataFrame:
        """The errors of a study with parameters that the filters take for others."""
        return pd.read_csv(self.layout.mismatch(study))

    def curves(self, study: str) -> pd.DataFrame:
        """The curves over k of a study, in long form."""
        return pd.read_csv(self.layout.curves(study))

    def ranking_table(self, study: str) -> pd.DataFrame:
        """How the filters of a study rank: one row a point and filter."""
        return pd.read_csv(self.layout.ranking(study))

    def error_over_k(self, study: str) -> pd.DataFrame:
        """The errors by which a study ranks, over the steps."""
        return pd.read_csv(self.layout.error_over_k(study))

    def error_shares(self, study: str) -> pd.DataFrame:
        """The distribution of those errors over the runs."""
        return pd.read_csv(self.layout.error_shares(study))

    def consistency_table(self, study: str) -> pd.DataFrame:
        """Whether the filters' own covariances are true."""
        return pd.read_csv(self.layout.consistency(study), keep_default_na=True)

    def bounds_table(self, study: str) -> pd.DataFrame:
        """Lower bounds of the errors, beside those of the filters."""
        return pd.read_csv(self.layout.bounds(study))

    def calibration(self, name: str) -> pd.DataFrame:
        """A table of what the search for fitted parameters has found."""
        return pd.read_csv(self.layout.calibration(f"{name}.csv"))

    def leaderboard(self) -> pd.DataFrame:
        """The rankings of all studies."""
        return pd.read_csv(self.layout.page("leaderboard.csv"))

    def diff(self) -> pd.DataFrame:
        """Published values and claims of all papers beside ours, with their verdicts."""
        return pd.read_csv(self.layout.page("diff.csv"))

    def robustness(self) -> pd.DataFrame:
        """The verdicts of all papers under every reading."""
        return pd.read_csv(self.layout.page("robustness.csv"))

    def authors(self) -> dict[str, str]:
        """Authors of the papers, by the papers' names."""
        return {of_study["paper"]: of_study["authors"] for of_study in self._studies.values()}

    def claims(self, paper: str) -> pd.DataFrame:
        """Every comparison that the claims of a paper are made of."""
        return pd.read_csv(self.layout.claims(paper))
