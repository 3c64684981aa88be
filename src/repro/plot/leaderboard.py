"""The leaderboard as a picture: a panel a study, a row a filter."""

from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from repro.plot import style
from repro.tables.ranking import geometric_mean
from repro.tables.results import Results

SMALLEST, LARGEST = 0.25, 40.0  # relative errors drawn; what is farther is drawn at the edge
ROW, HEADING = 0.21, 0.36  # inches of a filter and of the heading of its study
TICKS = (0.25, 0.5, 1, 2, 5, 10, 20, 40)


def leaderboard(results: Results) -> Figure:
    """Errors relative to the most informed reference on the first family of every study."""
    table = results.leaderboard()
    studies = {
        study: _relative(results, study, table[table["study"] == study])
        for study in map(str, table["study"].unique())
    }
    sizes = [HEADING + ROW * len(set(rows["filter"])) for rows, _ in studies.values()]
    drawn, grid = style.figure(
        len(studies),
        1,
        size=(7.7, sum(sizes) + 0.7),
        sharex=True,
        squeeze=False,
        gridspec_kw={"height_ratios": sizes},
    )
    for axes, (study, (rows, reference)) in zip(grid.flat, studies.items(), strict=True):
        _draw_study(axes, results, rows)
        points = len(set(rows["point"]))
        title = f"{study}: {points} {'point' if points == 1 else 'points'}, relative to {reference}"
        axes.set_title(title, fontsize=9, loc="left")
    last = grid.flat[-1]
    last.set(xscale="log", xlim=(SMALLEST, LARGEST))
    last.set_xticks(TICKS, [f"{tick:g}" for tick in TICKS])
    last.minorticks_off()
    last.set_xlabel("relative error (dot: root mean square, cross: median run)")
    return drawn


def _relative(results: Results, study: str, table: Any) -> tuple[pd.DataFrame, str]:
    """Rows of the first family with `ratio` and `median_ratio`, and what they are relative to.

    A point where the reference has no error is left out.
    """
    rows = table[table["family"] == table["family"].iloc[0]]
    informed = results.ranking(study).informed
    if informed in set(rows["filter"]):
        name, label = [informed] * len(rows), style.label(str(informed))
    else:
        name, label = rows["best_of_paper"], "the best of the paper's filters"
    of = rows.set_index(["point", "filter"])
    reference: Any = of.reindex(pd.MultiIndex.from_arrays([rows["point"], name]))
    ratios = {
        ratio: rows[column].to_numpy() / reference[column].replace(0.0, np.nan).to_numpy()
        for ratio, column in (("ratio", "error"), ("median_ratio", "median"))
    }
    return rows.assign(**ratios), label


def _draw_study(axes: Axes, results: Results, rows: Any) -> None:
    middle = {name: geometric_mean(of["ratio"]) for name, of in rows.groupby("filter")}
    names = sorted(middle, key=lambda name: middle[name])
    for place, name in enumerate(names):
        of = rows[rows["filter"] == name]
        look = style.look(results, name)
        low, high = of["ratio"].min(), of["ratio"].max()
        axes.plot([low, high], [place, place], lw=1.2, color=look["color"], alpha=0.6)
        shown = np.clip(middle[name], SMALLEST, LARGEST)
        off = {middle[name] < SMALLEST: "<", middle[name] > LARGEST: ">"}.get(True, "o")
        axes.plot(shown, place, off, color=look["color"], ms=6, clip_on=False)
        median = np.clip(geometric_mean(of["median_ratio"]), SMALLEST, LARGEST)
        axes.plot(median, place, "x", color="black", ms=4.5, clip_on=False, zorder=3)
    axes.axvline(1, color="black", lw=1)
    axes.set_yticks(np.arange(len(names)), [style.label(name) for name in names], fontsize=8)
    axes.set_ylim(len(names) - 0.4, -0.6)
