"""The leaderboard: every filter of every study, by family of points."""

import numpy as np
import pandas as pd
from tabulate import tabulate

from repro import plugins
from repro.atomic import atomic_write
from repro.tables.csv_file import write_csv

TITLE = "Leaderboard"
LEGEND = """\
For every study and family of points: the geometric mean over the points of each filter's error
(mean over k of the root of the mean squared error over the trials), relative to the reference that
knows most and to using no measurement; how many points it is better or worse on than the best of
the paper's filters, beyond the standard error of the paired difference; the largest share of runs
that lost their target. Every point: `leaderboard.csv`. Made by the run."""


def summarised(table: pd.DataFrame) -> pd.DataFrame:
    """One row a study, family and filter, from one row a study, point and filter."""
    rows = []
    for (study, family, filter_), of in table.groupby(["study", "family", "filter"], sort=False):
        verdicts = of["verdict"].value_counts()
        rows.append(
            {
                "study": study,
                "family": family,
                "filter": filter_,
                "whose": of["whose"].iloc[0],
                "points": len(of),
                "error": _geometric_mean(of["error"]),
                "of informed": _geometric_mean(of["relative_to_informed"]),
                "of no data": _geometric_mean(of["relative_to_nothing"]),
                "better": int(verdicts.get("better", 0)),
                "worse": int(verdicts.get("worse", 0)),
                "not decided": int(verdicts.get("not decided", 0)),
                "lost": of["lost"].max(),
            }
        )
    summary = pd.DataFrame(rows)
    order = summary.groupby(["study", "family"], sort=False).ngroup()
    return summary.assign(order=order).sort_values(["order", "error"]).drop(columns="order")


def _geometric_mean(values: pd.Series) -> float:
    return float(np.exp(np.log(values).mean()))


def write_leaderboard(rankings: dict[str, str], csv: str, markdown: str) -> None:
    """Write the leaderboard of all studies, given the file of each study's ranking."""
    table = pd.concat([pd.read_csv(path) for path in rankings.values()])
    write_csv(table, csv)
    text = [f"# {TITLE}", "", LEGEND, ""]
    for study, of_study in summarised(table).groupby("study", sort=False):
        text += [f"## {study}", ""]
        for family, rows in of_study.groupby("family", sort=False):
            text += [f"### {family}", "", _markdown(rows.drop(columns=["study", "family"])), ""]
    with atomic_write(markdown) as part:
        part.write_text("\n".join(text))


def _markdown(rows: pd.DataFrame) -> str:
    shown = rows.assign(filter=[plugins.filter_module(name).LABEL for name in rows["filter"]])
    return tabulate(
        shown.to_dict("list"), headers="keys", tablefmt="github", floatfmt=".3g", missingval=""
    ).replace("nan", "")
