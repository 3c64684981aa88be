"""Wall time, CPU time and memory of the jobs, by rule; CPU time a step of the filters."""

import re
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

import pandas as pd

from repro.layout import Catalogue, Layout
from repro.parameters.point_names import batch_of
from repro.workflow.job import OF_POINT, USAGE

_USED = re.compile(rf"{USAGE} cpu_s=(?P<cpu_s>[\d.]+) peak_mb=(?P<peak_mb>[\d.]+)")
_POINT = re.compile(rf"^{OF_POINT}(?P<point>.+): cpu_s=(?P<cpu_s>[\d.]+)$", re.MULTILINE)


def timings(root: str | Path) -> pd.DataFrame:
    """One row a rule: jobs, wall s (Snakemake's benchmark files), CPU s and peak MB (the jobs').

    The jobs report their memory: Snakemake samples it every half second and misses short jobs.
    """
    layout, rows = Layout(root), []
    for job in layout.timed_jobs():
        wall = pd.read_csv(layout.timing(*job), sep="\t")["s"].iloc[0]
        usage = _usage(layout.job_log(*job))
        if usage:
            rows.append({"rule": job[0], "wall_s": wall} | usage)
    table = pd.DataFrame(rows, columns=["rule", "wall_s", "cpu_s", "peak_mb"])
    by_rule = table.groupby("rule").agg(
        jobs=("wall_s", "size"),
        wall_s=("wall_s", "sum"),
        longest_s=("wall_s", "max"),
        cpu_s=("cpu_s", "sum"),
        peak_mb=("peak_mb", "max"),
    )
    return by_rule.sort_values("cpu_s", ascending=False)


def filter_times(
    root: str | Path,
    catalogue: Catalogue,
    points: Mapping[str, Mapping[str, Mapping[str, Any]]],
    shards: int,
) -> pd.DataFrame:
    """CPU time a trial and step of every filter on every point whose jobs have left their usage.

    `points` gives `family`, `trials` and `steps` of each study's points. The start of Python does
    not count, but loading compiled kernels does, in the first point of a job.
    """
    layout, rows = Layout(root), []
    for study, of_study in catalogue.items():
        for point, filters in of_study.items():
            at = points[study][point]
            where = {"study": study, "family": at["family"], "point": point}
            for filter_ in filters:
                logs = [
                    layout.job_log(filter_, study, batch_of(point), str(shard))
                    for shard in range(shards)
                ]
                seconds = [of.get(point) for of in map(_of_points, logs)]
                if None not in seconds:
                    cpu = 1e6 * sum(filter(None, seconds)) / (at["trials"] * at["steps"])
                    rows.append(where | {"filter": filter_, "cpu_us_per_step": cpu})
    return pd.DataFrame(rows, columns=["study", "family", "point", "filter", "cpu_us_per_step"])


@cache
def _of_points(log: str) -> dict[str, float]:
    """CPU seconds of each point of a job; none if it has left no usage."""
    path = Path(log)
    text = path.read_text(encoding="utf-8") if path.exists() else ""
    return {found["point"]: float(found["cpu_s"]) for found in _POINT.finditer(text)}


def _usage(log: str) -> dict[str, float] | None:
    """What a job has used; None if it has left no usage."""
    path = Path(log)
    usage = _USED.search(path.read_text(encoding="utf-8")) if path.exists() else None
    return {name: float(value) for name, value in usage.groupdict().items()} if usage else None
