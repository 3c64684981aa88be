"""Wall time, CPU time and memory of the jobs, by rule."""

import re
from pathlib import Path

import pandas as pd

from repro.layout import Layout
from repro.workflow.job import USAGE

_USED = re.compile(rf"{USAGE} cpu_s=(?P<cpu_s>[\d.]+) peak_mb=(?P<peak_mb>[\d.]+)")


def timings(root: str | Path) -> pd.DataFrame:
    """One row a rule: jobs, wall s (Snakemake's benchmark files), CPU s and peak MB (the jobs').

    The jobs report their memory: Snakemake samples it every half second and misses short jobs.
    """
    layout, rows = Layout(root), []
    for job in layout.timed_jobs():
        wall = pd.read_csv(layout.timing(*job), sep="\t")["s"].iloc[0]
        log = Path(layout.job_log(*job))
        usage = _USED.search(log.read_text()) if log.exists() else None
        if usage:
            rows.append(
                {"rule": job[0], "wall_s": wall}
                | {name: float(value) for name, value in usage.groupdict().items()}
            )
    table = pd.DataFrame(rows, columns=["rule", "wall_s", "cpu_s", "peak_mb"])
    by_rule = table.groupby("rule").agg(
        jobs=("wall_s", "size"),
        wall_s=("wall_s", "sum"),
        longest_s=("wall_s", "max"),
        cpu_s=("cpu_s", "sum"),
        peak_mb=("peak_mb", "max"),
    )
    return by_rule.sort_values("cpu_s", ascending=False)
