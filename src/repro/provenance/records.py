"""Results that were made under other records of Snakemake than those at hand.

By its records Snakemake knows that a parameter, a setting or a file of code has changed. Where they
are lost, or another clone's, it would take any result for a good one.
"""

import json
import uuid
from collections.abc import Callable, Collection, Mapping
from pathlib import Path
from typing import Any

from repro.atomic import atomic_write
from repro.errors import ReproError
from repro.layout import Layout
from repro.logs import logged_origin
from repro.origin import check_origin, of_shard, origin
from repro.parameters.point_names import batch_of
from repro.provenance.manifest import check_manifest
from repro.statistics.runs import check_runs

Origins = Mapping[str, Mapping[str, Mapping[str, Any]]]  # as of `repro.tables.results.Origins`


class Records:
    """Snakemake's folder of records and a folder of results, and whether they belong together."""

    def __init__(self, records: str | Path, layout: Layout):
        self._layout = layout
        self._own, self._owner = Path(records, "results_of"), layout.root / ".records"
        self._name = _read(self._own) or str(uuid.uuid4())

    def check(self, origins: Callable[[], Origins], shards: int, code: Callable[[], str]) -> None:
        """Whether results of other records are what a run would make now.

        `origins` gives those of all studies, `code` the digest that the manifest must have.
        Raises ReproError if not, in one line that names the first result that is stale.
        """
        if _read(self._owner) == self._name:
            return
        try:
            there = self._logs_and_runs()
            for study, points in origins().items() if there else ():
                for point, of_point in points.items():
                    for shard in range(shards):
                        trials = of_shard(of_point["trials"], shard, shards)
                        self._check_point(study, point, shard, of_point, trials, there)
            self._check_tables(code())
        except ReproError as error:
            raise ReproError(
                f"{error} ({self._layout.root} was made by another clone, or .snakemake is lost)"
            ) from None

    def take(self) -> None:
        """From now on the results are those of these records."""
        for file in (self._own, self._owner):
            if _read(file) != self._name:
                file.parent.mkdir(parents=True, exist_ok=True)
                with atomic_write(file) as part:
                    part.write_text(self._name, encoding="utf-8")

    def _logs_and_runs(self) -> set[str]:
        folders = (self._layout.root / kind for kind in ("logs", "runs"))
        return {str(file) for folder in folders for file in folder.rglob("*")}

    def _check_point(
        self,
        study: str,
        point: str,
        shard: int,
        made: Mapping[str, Any],
        trials: tuple[int, int],
        there: Collection[str],
    ) -> None:
        log = self._layout.log(study, made["log_of"], shard)
        if log in there:
            check_origin(log, logged_origin(log), origin(made["log"], trials))
        for name, made_with in made["filters"].items():
            runs = self._layout.run(study, batch_of(point), name, shard)
            if runs in there:
                check_runs(runs, point, origin(made_with, trials))

    def _check_tables(self, code: str) -> None:
        """Those of a complete run are in its manifest, with the code that made them."""
        tables = sorted((self._layout.root / "tables").glob("*.csv"))
        manifest = Path(self._layout.page("manifest.json"))
        if not tables:
            return
        if not manifest.exists():
            raise ReproError(f"{tables[0]}: of a run that was not completed: remove it, run again")
        if json.loads(manifest.read_text(encoding="utf-8")).get("code") != code:
            raise ReproError(f"{tables[0]}: stale: made by other code: remove it and run again")
        check_manifest(manifest)


def _read(file: Path) -> str | None:
    return file.read_text(encoding="utf-8") if file.exists() else None
