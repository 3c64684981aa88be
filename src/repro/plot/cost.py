"""Error over the CPU time of a step: what a practitioner chooses a filter by."""

from pathlib import Path
from typing import Any

import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from repro import plugins
from repro.plot import style
from repro.tables.results import Results

PANELS = 4


def cost(results: Results, study: str, table: str | Path) -> Figure:
    """A panel a point: the first of the study, and those that sweep particles, joined by a line."""
    rows = pd.read_csv(table).dropna(subset=["cpu_us_per_step"])
    swept = rows.loc[rows["particles"].notna(), "where"]
    points = list(dict.fromkeys([*rows["where"].head(1), *swept]))[:PANELS]
    columns = min(max(len(points), 1), 2)
    lines = -(-max(len(points), 1) // columns)
    drawn, grid = style.figure(lines, columns, size=(7.7, 3.4 * lines), squeeze=False)
    for axes in grid.flat[len(points) :]:
        axes.remove()
    for axes, point in zip(grid.flat, points, strict=False):
        _draw(axes, results, rows.loc[rows["where"] == point])
        unit = plugins.study(study).error_unit
        axes.set(
            xscale="log",
            xlabel="CPU time of a trial's step in µs",
            ylabel=f"error{f' in {unit}' if unit else ''}",
        )
        axes.set_title(f"{study}, {point}", fontsize=9.5)
        axes.legend(fontsize=7)
    return drawn


def _draw(axes: Axes, results: Results, rows: pd.DataFrame) -> None:
    for filter_, of in rows.groupby("filter", sort=False):
        look, label = style.look(results, str(filter_)), style.label(str(filter_))
        alone_look: Any = look | {"linestyle": "", "marker": look["marker"].replace("None", "_")}
        alone, swept = of.loc[of["particles"].isna()], of.loc[of["particles"].notna()]
        axes.plot(alone["cpu_us_per_step"], alone["error"], ms=7, label=label, **alone_look)
        if len(swept):
            first, last = swept["particles"].iloc[[0, -1]].astype(int)
            name = f"{label}, {first} to {last} particles"
            axes.plot(swept["cpu_us_per_step"], swept["error"], ms=4, lw=1, label=name, **look)
    style.error_axis(axes, "y")
