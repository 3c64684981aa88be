"""Which filters run on which points: filled by the filters' rules, read by everything else."""

import json
import re
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from fnmatch import fnmatchcase
from functools import cached_property
from pathlib import Path
from typing import Any

from repro.atomic import atomic_write
from repro.errors import ReproError
from repro.layout import Catalogue, Layout
from repro.parameters.load import Point
from repro.parameters.point_names import batch_of, is_common, own_table

# The wildcards of a filter's output: see Registry.runs.
OUTPUT = re.compile(r"\{study,(?P<studies>[\w|]+)\}.*\{filter,(?P<filter>[\w|]+)\}")
FILTER_MODULE = "repro.filters.{filter}"  # in a rule's code(...): that of the filter it runs
Settings = dict[str, dict[str, dict[str, dict[str, Any]]]]  # study -> point -> filter -> settings
Patterns = str | Sequence[str]  # one or several shell patterns


def filter_file(name: str) -> Path:
    """The file of a filter of this name."""
    return Path(__file__).parents[1] / "filters" / f"{name}.py"


def write_catalogue(filters: Catalogue, settings: Settings, path: str | Path) -> None:
    """Write which filters run where, and their settings, as JSON: for tests and for a reader."""
    with atomic_write(path) as part:
        part.write_text(
            json.dumps({"filters": filters, "settings": settings}, indent=1) + "\n",
            encoding="utf-8",
        )


def matching_points(
    points: Iterable[str], chosen: Patterns = "*", skipped: Patterns = ()
) -> list[str]:
    """Points that match a pattern of `chosen` and none of `skipped`."""
    return [p for p in points if _matches(p, chosen) and not _matches(p, skipped)]


def _matches(point: str, patterns: Patterns) -> bool:
    several = [patterns] if isinstance(patterns, str) else patterns
    return any(fnmatchcase(point, pattern) for pattern in several)


class Registry:
    """The filters of every point, and the files that their jobs write."""

    def __init__(
        self,
        layout: Layout,
        points: Mapping[str, Mapping[str, Point]],
        shards: int,
        left_out: Mapping[str, Collection[str]] | None = None,
        log_of: Mapping[str, Mapping[str, str]] | None = None,
    ):
        """`points` are each study's points by name; `shards` the jobs of each point.

        On points that are `left_out`, by study, no filter runs, though rules may name them.
        `log_of` has for each study the point whose log a point reads, where not its own.
        """
        self._left_out, self._log_of = left_out or {}, log_of or {}
        self._layout, self._shards = layout, range(shards)
        self._filters: Catalogue = {
            study: {p: [] for p in named} for study, named in points.items()
        }
        self._points = points
        self._given: dict[tuple[str, str], dict[str, Any]] = {}  # by filter and study

    def runs(
        self, name: str, studies: list[str], points: Patterns = "*", skip: Patterns = ()
    ) -> str:
        """Output of a filter's rule; registers the filter on the matching points of the studies.

        On a point of a table of its own (see `own_table`) a filter runs if the point's family
        sweeps a setting of it, whatever the patterns.
        Raises ReproError for an unknown filter or study, for a pattern that no point matches, and
        for a study on which another rule runs the filter.
        """
        if not filter_file(name).exists():
            raise ReproError(f"filter {name}: there is no {filter_file(name)}; write it first")
        for study in studies:
            if study not in self._filters:
                known = ", ".join(self._filters)
                raise ReproError(
                    f"filter {name}: there is no study '{study}'; the studies are {known}"
                )
            if any(name in filters for filters in self._filters[study].values()):
                raise ReproError(
                    f"filter {name}: two rules run it on {study}; "
                    "fix the name or studies in runs(...) of one of them"
                )
            common = [point for point in self._filters[study] if not own_table(point)]
            matching = matching_points(common, points, skip)
            if not matching:
                raise ReproError(
                    f"filter {name}: no point of {study} matches {points}; fix the pattern"
                )
            for point in [*matching, *self._swept(name, study)]:
                if point not in self._left_out.get(study, ()):
                    self._filters[study][point].append(name)
        return self._layout.run(**_only(name, studies))

    def _swept(self, name: str, study: str) -> list[str]:
        """Points of tables of their own that sweep a setting of the filter."""
        return [
            point
            for point in filter(own_table, self._filters[study])
            if name in swept_filters(self._points[study][point].swept)
        ]

    def listed(self, study: str, names: Sequence[str]) -> str:
        """Output of the rule of the filters that a study lists for all of its points."""
        for name in names:
            self.runs(name, [study])
        return self._layout.run(**_only("|".join(names), [study]))

    def read_settings(self, rules: Iterable[Any]) -> None:
        """Take the settings that the rules of the filters give on the spot, and check the rules.

        Raises ReproError where a rule names another filter than its output does.
        """
        for rule in rules:
            output = OUTPUT.search(str(rule.output[0])) if rule.output else None
            if output is None:
                continue
            named = output.groupdict()
            params = dict(rule.params.items())
            _check_rule(rule.name, params)
            given = params.get("settings")
            if given is None or callable(given):
                continue
            if not isinstance(given, dict):
                raise ReproError(
                    f"rule {rule.name}: params: settings is a {type(given).__name__}; "
                    "write settings=dict(name=value)"
                )
            for study in named["studies"].split("|"):
                for filter_ in named["filter"].split("|"):
                    self._given[filter_, study] = given

    def settings(self, name: str, study: str, point: str | None = None) -> dict[str, Any]:
        """Settings at a point, or by point: as the filter's rule gives them, else from params/."""
        if point is None:
            return {p: self.settings(name, study, p) for p in self._points.get(study, {})}
        of_point = self._points[study][point].filters.get(name, {})
        return self._given.get((name, study), of_point)

    def all_settings(self, *studies: str) -> Settings:
        """Settings of every filter on every point of the studies."""
        return {
            study: {
                point: {name: self.settings(name, study, point) for name in names}
                for point, names in self._filters[study].items()
                if names
            }
            for study in studies
        }

    def own_filters(self, known: Iterable[str]) -> list[str]:
        """Filters that are not among the known ones, in the order of their rules."""
        names = (
            name for points in self._filters.values() for found in points.values() for name in found
        )
        return [name for name in dict.fromkeys(names) if name not in known]

    def catalogue(self, *studies: str, requested: bool = False, table: str = "") -> Catalogue:
        """Filters by study and point, without points that have none.

        Points on request, and those of tables of their own, are left out unless they are
        `requested`, or of that `table`.
        """
        return {
            study: {
                point: filters
                for point, filters in self._filters[study].items()
                if filters
                and (requested or is_common(point) or (table and own_table(point) == table))
            }
            for study in studies
        }

    def run_files(
        self,
        study: str,
        points: Collection[str] | None = None,
        requested: bool = False,
        table: str = "",
    ) -> list[str]:
        """Files that hold the runs of all filters on the given (or all) points of a study.

        Which points these are at most: see `catalogue`.
        """
        batches = {
            (batch_of(point), name): None
            for point, filters in self._chosen(study, points, requested, table)
            for name in filters
        }
        return [
            self._layout.run(study, *batch_and_filter, shard)
            for batch_and_filter in batches
            for shard in self._shards
        ]

    def log_files(
        self, study: str, points: Collection[str] | None = None, table: str = ""
    ) -> list[str]:
        """Logs of the given (or all) points of a study that a filter runs on: see `catalogue`."""
        chosen = self._chosen(study, points, table=table)
        of_points = dict.fromkeys(self.log_of(study, p) for p, _ in chosen)
        return [self._layout.log(study, p, shard) for p in of_points for shard in self._shards]

    def log_marks(
        self, study: str, points: Collection[str] | None = None, table: str = ""
    ) -> list[str]:
        """Of each job that makes logs of the given (or all) points: its first log.

        It stands for all of them. Snakemake takes time and memory for each file that a job names;
        see `repro.workflow.unnamed_logs` for those that it does not name.
        """
        chosen = [p for p, _ in self._chosen(study, points, table=table)]
        return [
            self._layout.log(study, p, shard)
            for p in self.first_logged(study, chosen)
            for shard in self._shards
        ]

    def first_logged(self, study: str, points: Iterable[str]) -> list[str]:
        """Points whose logs are the first of the jobs that make those of the given points."""
        jobs = dict.fromkeys(batch_of(self.log_of(study, p)) for p in points)
        return [self._first_logged[study, batch] for batch in jobs]

    @cached_property
    def _first_logged(self) -> dict[tuple[str, str], str]:
        return {(study, batch): points[0] for study, batch, points in self.batches()}

    def log_of(self, study: str, point: str) -> str:
        """The point whose log a point reads."""
        return self._log_of.get(study, {}).get(point, point)

    def batches(self) -> Iterator[tuple[str, str, list[str]]]:
        """Study, name of the batch and those points that one job makes the logs of a shard of."""
        for study, filters in self._filters.items():
            simulated = [p for p in filters if p not in self._left_out.get(study, ())]
            points = [p for p in simulated if self.log_of(study, p) == p]
            for batch in dict.fromkeys(map(batch_of, points)):
                yield study, batch, [p for p in points if batch_of(p) == batch]

    def in_batch(self, name: str, study: str, batch: str) -> list[str]:
        """Points of a batch that the filter runs on."""
        filters = self._filters[study]
        return [p for p in filters if name in filters[p] and batch_of(p) == batch]

    def _chosen(
        self,
        study: str,
        points: Collection[str] | None,
        requested: bool = False,
        table: str = "",
    ) -> list[tuple[str, list[str]]]:
        of_study = self.catalogue(study, requested=requested, table=table)[study]
        return [(p, filters) for p, filters in of_study.items() if points is None or p in points]


def swept_filters(swept: Mapping[str, Any]) -> set[str]:
    """The filters of which a family sweeps a setting, written filter.setting."""
    keys = [key for several in swept for key in several.replace(" ", "").split(",")]
    return {key.partition(".")[0] for key in keys if "." in key}


def _check_rule(rule: str, params: dict[str, Any]) -> None:
    """Raise ReproError if anything in a filter's rule is of another filter than its output."""
    for name, value in params.items():
        if name in ("settings", "code") or (name in ("points", "made_with") and callable(value)):
            continue
        raise ReproError(
            f"rule {rule}: params: '{name}' has no meaning; the filter is that of runs(...), "
            "and its settings are settings=dict(name=value)"
        )
    if FILTER_MODULE not in getattr(params.get("code"), "modules", ()):
        raise ReproError(
            f"rule {rule}: params: code must reach {FILTER_MODULE}; leave out code, "
            "and 'use rule run_filter' gives it"
        )


def _only(name: str, studies: list[str]) -> dict[str, str]:
    """Wildcards that match this filter on these studies."""
    return {"study": f"{{study,{'|'.join(studies)}}}", "filter_": f"{{filter,{name}}}"}
