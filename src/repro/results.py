"""What the jobs have left under results/, for the tables, claims and figures that need it."""

from collections.abc import Mapping
from functools import partial
from pathlib import Path

import numpy as np
import pandas as pd

from repro.logs import Log, read_log
from repro.shards import Shards
from repro.studies import Runs

Catalogue = dict[str, dict[str, list[str]]]  # study -> point -> filters that run on it


class Results:
    """Logs, runs and tables by name, all shards together."""

    def __init__(self, root: str | Path, catalogue: Catalogue, shards: int):
        self.root, self.catalogue, self.shards = Path(root), catalogue, shards

    def filters(self, study: str, point: str) -> list[str]:
        """Filters that run on a point, in the order of the catalogue of rules."""
        return self.catalogue[study][point]

    def log(self, study: str, point: str) -> Log:
        """The log of a point."""
        return self._log(self.root / "logs" / study / point)

    def flight(self, study: str, point: str, filter_: str) -> Log:
        """The log of what was flown on a filter's estimates, in a closed loop."""
        return self._log(self.root / "flights" / study / point / filter_)

    def _log(self, folder: Path) -> Log:
        logs = [read_log(folder / f"{shard}.mcap") for shard in range(self.shards)]
        return logs[0]._replace(
            trials=np.concatenate([log.trials for log in logs]),
            values={
                topic: np.concatenate([log.values[topic] for log in logs])
                for topic in logs[0].values
            },
        )

    def runs(self, study: str, point: str, filter_: str) -> Runs:
        """The runs of a filter on a point, all shards in memory."""
        parts = [self._shard(study, point, filter_, shard) for shard in range(self.shards)]
        claimed = [part.claimed for part in parts]
        shared = claimed[0] is None or claimed[0].ndim == 2
        return Runs(
            error=np.concatenate([part.error for part in parts]),
            claimed=claimed[0] if shared else np.concatenate(claimed),
            degenerate=np.concatenate([part.degenerate for part in parts]),
            recorded={
                name: np.concatenate([part.recorded[name] for part in parts])
                for name in parts[0].recorded
            },
        )

    def in_shards(self, study: str, point: str, filter_: str) -> Shards:
        """The same, one shard at a time in memory."""
        numbers = range(self.shards)
        return Shards(
            [partial(self._shard, study, point, filter_, shard) for shard in numbers],
            [len(self._file(study, point, filter_, shard)["trials"]) for shard in numbers],
        )

    def _file(self, study: str, point: str, filter_: str, shard: int) -> Mapping[str, np.ndarray]:
        return np.load(self.root / "runs" / study / point / filter_ / f"{shard}.npz")

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
        return pd.read_csv(self.root / "tables" / f"{study}.csv")

    def curves(self, study: str) -> pd.DataFrame:
        """The curves over k of a study, in long form."""
        return pd.read_csv(self.root / "curves" / f"{study}.csv")

    def diff(self) -> pd.DataFrame:
        """Published values and claims of all papers beside ours, with their verdicts."""
        return pd.read_csv(self.root / "diff.csv")

    def claims(self, paper: str) -> pd.DataFrame:
        """Every comparison that the claims of a paper are made of."""
        return pd.read_csv(self.root / "claims" / f"{paper}.csv")
