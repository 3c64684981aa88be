"""Errors of filters that take a parameter for another than it is, over what they take it for."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from repro.plot import style
from repro.plot.style import BAND
from repro.tables.results import Results

COLUMNS = 3


def mismatch(results: Results, studies: Sequence[str]) -> Figure:
    """A panel a parameter: error over that with the right value; a dotted line at the true one."""
    table = pd.concat([results.mismatch(study) for study in studies])
    panels: Any = list(table.groupby(["study", "parameter"], sort=False))
    columns = 2 if len(panels) == 4 else min(len(panels), COLUMNS)
    rows = -(-len(panels) // columns)
    drawn, grid = style.figure(rows, columns, size=(8.2, 2.6 * rows + 0.4), squeeze=False)
    for axes in grid.flat[len(panels) :]:
        axes.remove()
    for axes, ((study, parameter), of) in zip(grid.flat, panels, strict=False):
        numbers = pd.Series(pd.to_numeric(of["assumed"], errors="coerce"))
        if not numbers.isna().any():
            _over_numbers(axes, results, of.assign(assumed=numbers, true=of["true"].astype(float)))
        else:
            _over_names(axes, results, of)
        axes.axhline(1.0, color="0.4", lw=0.8, zorder=0)
        axes.set_title(f"{study}", fontsize=9)
        axes.set_xlabel(f"assumed {str(parameter).replace('_', ' ')}", fontsize=8.5)
        axes.legend(fontsize=7)
    for axes in grid[:, 0]:
        axes.set_ylabel("error, relative to the\nright parameter", fontsize=8.5)
    return drawn


def _over_numbers(axes: Axes, results: Results, table: pd.DataFrame) -> None:
    axes.axvline(table["true"].iloc[0], color="0.4", lw=1, ls=":", zorder=0)
    for filter_, rows in table.groupby("filter", sort=False):
        look = style.look(results, str(filter_))
        ordered = rows.sort_values("assumed")
        axes.plot(
            ordered["assumed"],
            ordered["relative"],
            ms=4,
            lw=1.2,
            label=style.label(str(filter_)),
            **look,
        )
        axes.fill_between(
            ordered["assumed"],
            ordered["relative"] - BAND * ordered["relative_mcse"],
            ordered["relative"] + BAND * ordered["relative_mcse"],
            color=look["color"],
            alpha=0.18,
            lw=0,
        )
        axes.plot(
            ordered["assumed"], ordered["relative_median"], lw=0.9, ls=":", color=look["color"]
        )
    style.error_axis(axes, "y")


def _over_names(axes: Axes, results: Results, table: pd.DataFrame) -> None:
    """The wrong names alone; those of the filters side by side."""
    wrong = table.loc[table["assumed"] != table["true"]]
    cases = list(dict.fromkeys(zip(wrong["true"], wrong["assumed"], strict=True)))
    filters = list(dict.fromkeys(wrong["filter"]))
    for place, filter_ in enumerate(filters):
        rows = wrong.loc[wrong["filter"] == filter_].set_index(["true", "assumed"]).loc[cases]
        axes.errorbar(
            np.arange(len(cases)) + 0.16 * (place - (len(filters) - 1) / 2),
            rows["relative"],
            yerr=BAND * rows["relative_mcse"],
            ls="none",
            ms=5,
            label=style.label(filter_),
            **{k: v for k, v in style.look(results, filter_).items() if k != "linestyle"},
        )
    axes.set_xticks(range(len(cases)), [f"{name}\n({true} true)" for true, name in cases])
    axes.set_xlim(-0.5, len(cases) - 0.5)
