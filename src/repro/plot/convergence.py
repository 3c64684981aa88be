"""Errors over the number of particles, and the rate at which estimates approach their limit."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from repro import plugins
from repro.plot import style
from repro.plot.style import BAND
from repro.tables.results import Results


def convergence(results: Results, studies: Sequence[str]) -> Figure:
    """A column a point: above the error, below the distance of the estimates from the reference."""
    table = pd.concat([results.convergence(study) for study in studies])
    groups: Any = list(table.groupby(["study", "where"], sort=False))
    drawn, grid = style.figure(2, len(groups), size=(8.6, 5.2), squeeze=False, sharex="col")
    for (above, below), ((study, where), rows) in zip(grid.T, groups, strict=True):
        above.set_title(f"{study}\n{where}", fontsize=8.5)
        for filter_, of in rows.groupby("filter", sort=False):
            _draw(above, below, results, str(filter_), of)
        for axes in (above, below):
            axes.set_xscale("log")
            for count in rows["printed"].dropna().unique():
                axes.axvline(count, color="0.4", lw=1, ls=":", zorder=0)
        style.error_axis(above, "y")
        style.error_axis(below, "y")
        below.set_xlabel("particles")
        below.legend(fontsize=6.5, loc="lower left")
        unit = plugins.study(str(study)).error_unit
        if (above, below) == tuple(grid[:, 0]):
            above.set_ylabel(f"error{f' in {unit}' if unit else ''}")
            below.set_ylabel("rms distance from\nthe most particles")
    grid[0, 0].legend(fontsize=7)
    return drawn


def _draw(above: Axes, below: Axes, results: Results, filter_: str, rows: pd.DataFrame) -> None:
    look = style.look(results, filter_)
    above.plot(rows["particles"], rows["error"], ms=4, lw=1.2, label=style.label(filter_), **look)
    above.fill_between(
        rows["particles"],
        rows["error"] - BAND * rows["mcse"],
        rows["error"] + BAND * rows["mcse"],
        color=look["color"],
        alpha=0.18,
        lw=0,
    )
    few = rows.loc[rows["particles"] != rows["reference"]]
    squared, mcse = few["squared_distance"], few["squared_distance_mcse"]
    rate = rows.iloc[0]
    below.errorbar(
        few["particles"],
        np.sqrt(squared),
        yerr=BAND * mcse / (2.0 * np.sqrt(squared)),
        ms=4,
        lw=1.2,
        label=_rate(rate),
        **look,
    )


def _rate(row: pd.Series) -> str:
    """The rate of the mean square, from the printed number of particles on if it is known."""
    kind = "rate_beyond" if np.isfinite(row["rate_beyond"]) else "rate"
    return f"rate {row[kind]:.2f} ± {row[f'{kind}_mcse']:.2f}"
