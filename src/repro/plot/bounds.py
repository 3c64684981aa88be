"""How far every filter is from a lower bound of the errors, over k."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from repro.plot import style
from repro.tables.results import Results

COLUMNS, PANEL = 2, (3.8, 3.0)  # inches


def draw(results: Results, studies: Sequence[str]) -> Figure:
    """A panel for each point, component and bound: error of each filter over the bound."""
    table: Any = pd.concat([results.bounds_table(study) for study in studies])
    table = table[table["k"].notna() & np.isfinite(table["ratio"])]
    panels = list(table.groupby(["study", "point", "component", "bound"], sort=False))
    rows = -(-max(len(panels), 1) // COLUMNS)
    size = COLUMNS * PANEL[0], rows * PANEL[1]
    drawn, axes = style.figure(rows, COLUMNS, size, squeeze=False)
    for each in axes.flat[len(panels) :]:
        each.axis("off")
    for ((study, point, component, bound), found), each in zip(panels, axes.flat, strict=False):
        each.axhline(1.0, color="0.3", linewidth=1, linestyle=":")
        for name, of_filter in found.groupby("filter", sort=False):
            look = style.look(results, str(name)) | {"marker": ""}
            each.plot(of_filter["k"], of_filter["ratio"], label=style.label(str(name)), **look)
        each.set_title(f"{study}, {point}: {component}\n{bound}", loc="left", fontsize=9)
        style.error_axis(each, "y")
        each.set_xlabel("k")
    for row in axes:
        row[0].set_ylabel("RMSE over the bound")
    named = {}
    for each in axes.flat:
        handles, labels = each.get_legend_handles_labels()
        named |= dict(zip(labels, handles, strict=True))
    place: Any = "outside upper center"
    drawn.legend([*named.values()], [*named], loc=place, ncols=4, fontsize=8)
    return drawn
