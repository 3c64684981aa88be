"""Wall time, CPU time and memory of the jobs, by rule."""

import re
from pathlib import Path

import pandas as pd

from repro.workflow.job import USAGE

_USED = re.compile(rf"{USAGE} cpu_s=(?P<cpu_s>[\d.]+) peak_mb=(?P<peak_mb>[\d.]+)")


def timings(root: str | Path) -> pd.DataFrame:
    """One row a rule: jobs, wall s (Snakemake's benchmark files), CPU s and peak MB (the jobs').

    Snakemake samples memory every half second, which short jobs escape; so the jobs say it.
    """
    rows = []
    for benchmark in sorted((Path(root) / "timings").rglob("*.tsv")):
        place = benchmark.relative_to(Path(root) / "timings")
        wall = pd.read_csv(benchmark, sep="\t")["s"].iloc[0]
        log = (Path(root) / "job_logs" / place).with_suffix(".log")
        used = _USED.search(log.read_text()) if log.exists() else None
        if used:
            rows.append(
                {"rule": place.parts[0], "wall_s": wall}
                | {name: float(value) for name, value in used.groupdict().items()}
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
