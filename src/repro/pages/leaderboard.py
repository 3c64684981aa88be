"""The leaderboard: every filter of every study, by family of points."""

from collections.abc import Mapping
from typing import Any

import numpy as np
import pandas as pd

from repro import plugins
from repro.atomic import atomic_write
from repro.pages.markdown import markdown_table
from repro.tables.csv_file import write_csv
from repro.tables.ranking import geometric_mean

TITLE = "Leaderboard"
LEGEND = """\
For every study and family of points, the best filter first. Error: geometric mean over the points
of each filter's error (mean over k of the root of the mean squared error over the trials). Median
run: the same of the median over the runs of each run's error, which a few runs that lost their
target do not move. The error relative to the reference that knows most ("of informed"), and to
using no measurement ("of no data"), on the points that have both. On how many points it is better
or worse than the best of the paper's filters, beyond the standard error of the paired difference;
the best itself counts as neither. Lost: the largest share of runs that lost their target. CPU: of
the whole job, its start included, so that it says most where a study has many steps. Columns
without a value are left out. Every point: `leaderboard.csv`. Made by the run."""
CPU = "CPU µs a step"


def summarised(table: pd.DataFrame) -> pd.DataFrame:
    """One row a study, family and filter, from one row a study, point and filter."""
    rows = []
    groups: Any = table.groupby(["study", "family", "filter"], sort=False)
    for (study, family, filter_), of in groups:
        verdicts = of["verdict"].value_counts()
        rows.append(
            {
                "study": study,
                "family": family,
                "filter": filter_,
                "whose": of["whose"].iloc[0],
                "points": len(of),
                "error": geometric_mean(of["error"]),
                "median run": geometric_mean(of["median"]),
                "of informed": geometric_mean(of["relative_to_informed"]),
                "of no data": geometric_mean(of["relative_to_nothing"]),
                "better": int(verdicts.get("better", 0)),
                "worse": int(verdicts.get("worse", 0)),
                "not decided": int(verdicts.get("not decided", 0)),
                "lost": of["lost"].max(),
            }
        )
    summary = pd.DataFrame(rows)
    order = summary.groupby(["study", "family"], sort=False).ngroup()
    summary = summary.assign(order=order).sort_values(["order", "error"], kind="stable")
    return summary.drop(columns="order")


def with_cpu(summary: pd.DataFrame, times: pd.DataFrame) -> pd.DataFrame:
    """The summary with CPU time: the median over the family's points that it is known for."""
    cpu = times.groupby(["study", "family", "filter"])["cpu_us_per_step"].median()
    keys = pd.MultiIndex.from_arrays([summary[name] for name in ("study", "family", "filter")])
    return summary.assign(**{CPU: cpu.reindex(keys).to_numpy()})


def write_leaderboard(
    rankings: Mapping[str, str], csv: str, markdown: str, times: pd.DataFrame | None = None
) -> None:
    """Write the leaderboard of all studies, given the file of each study's ranking.

    Only the page has CPU times, `repro.workflow.timings.filter_times`: the CSV file depends on no
    machine.
    """
    table = pd.concat([pd.read_csv(path) for path in rankings.values()])
    write_csv(table, csv)
    summary = summarised(table)
    if times is not None:
        summary = with_cpu(summary, times)
    text = [f"# {TITLE}", "", LEGEND, ""]
    for study, of_study in summary.groupby("study", sort=False):
        text += [f"## {study}", ""]
        for family, rows in of_study.groupby("family", sort=False):
            text += [f"### {family}", "", _markdown(rows.drop(columns=["study", "family"])), ""]
    with atomic_write(markdown) as part:
        part.write_text("\n".join(text), encoding="utf-8")


def _markdown(rows: pd.DataFrame) -> str:
    labels = [plugins.filter_module(name).LABEL for name in rows["filter"]]
    shown = rows.assign(filter=labels).dropna(axis="columns", how="all")
    if not rows[["better", "worse", "not decided"]].to_numpy().any():
        shown = shown.drop(columns=["better", "worse", "not decided"])
    rows_of_texts = [[_cell(value) for value in row] for row in shown.itertuples(index=False)]
    return markdown_table(list(shown), rows_of_texts, _sides(shown))


def _sides(shown: pd.DataFrame) -> list[str]:
    return ["right" if pd.api.types.is_numeric_dtype(shown[name]) else "left" for name in shown]


def _cell(value: object) -> str:
    """Three digits; empty where a value is not known."""
    if not isinstance(value, float):
        return str(value)
    if np.isnan(value):
        return ""
    return f"{value:.0f}" if 1e3 <= abs(value) < 1e6 else f"{value:.3g}"
