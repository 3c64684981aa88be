"""Are the filters' own covariances true? NEES and coverage of every filter, point by point."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from repro.plot import style
from repro.tables.results import Results

ROW, MARGIN = 0.24, 0.75  # inches of a filter, and of the rest of a panel
MARKERS = "osD^"
FURTHEST = 1e3  # NEES at the edge of the axis


def draw(results: Results, studies: Sequence[str]) -> Figure:
    """A row of panels for each study and point: NEES, and the shares inside the regions."""
    table: Any = pd.concat([results.consistency_table(study) for study in studies])
    table = table[table["k"].isna()]
    panels = list(table.groupby(["study", "point"], sort=False))
    filters = [found["filter"].nunique() for _, found in panels]
    heights = [MARGIN + ROW * count for count in filters]
    drawn, axes = style.figure(
        len(panels),
        2,
        (7.6, sum(heights)),
        squeeze=False,
        gridspec_kw={"height_ratios": heights, "width_ratios": (3, 2)},
    )
    for ((study, point), found), (left, right) in zip(panels, axes, strict=True):
        names = list(dict.fromkeys(found["filter"]))
        _nees(left, found, names)
        _coverage(right, found, names)
        left.set_title(f"{study}, {point}", loc="left")
        right.set_title("inside the 50 % and 95 % regions", loc="left", fontsize=8)
        left.set_yticks(range(len(names)), [style.label(name) for name in names])
        right.set_yticks(range(len(names)), [])
        for each in (left, right):
            each.set_ylim(len(names) - 0.5, -0.5)
    axes[-1, 0].set_xlabel("NEES (1: the covariance is true)")
    axes[-1, 1].set_xlabel("share of the errors")
    return drawn


def _nees(axes: Axes, found: Any, names: list[str]) -> None:
    """Each with the bounds of a true covariance; a mark at the edge is beyond it."""
    components = list(dict.fromkeys(found.loc[found["metric"] == "nees", "component"]))
    axes.axvline(1.0, color="0.4", linewidth=1)
    for n, component in enumerate(components):
        rows = found[(found["metric"] == "nees") & (found["component"] == component)]
        place = np.array([names.index(name) for name in rows["filter"]])
        place = place + 0.22 * (n - (len(components) - 1) / 2)
        axes.hlines(place, rows["lower"], rows["upper"], color="0.8", linewidth=5)
        beyond = rows["value"] > FURTHEST
        value = rows["value"].clip(upper=FURTHEST)
        options: dict[str, Any] = dict(color=f"C{n}", linestyle="none", label=component)
        axes.plot(value[~beyond], place[~beyond], marker=MARKERS[n], markersize=4.5, **options)
        axes.plot(value[beyond], place[beyond], marker=">", markersize=6, color=f"C{n}", ls="none")
    axes.set_xscale("log")
    low, high = axes.get_xlim()
    axes.set_xlim(min(low, 0.5), max(min(high, 1.5 * FURTHEST), 2.0))
    if axes.get_xlim()[1] < 50:
        style.plain_log(axes, "x")
    if len(components) > 1:
        axes.legend(fontsize=8, loc="best")


def _coverage(axes: Axes, found: Any, names: list[str]) -> None:
    for colour, share in (("C0", 50), ("C3", 95)):
        rows = found[found["metric"] == f"coverage_{share}"]
        rows = rows.groupby("filter", sort=False)["value"].mean()
        axes.axvline(share / 100, color=colour, linewidth=1, linestyle=":")
        place = [names.index(str(name)) for name in rows.index]
        axes.plot(rows, place, "o", color=colour, markersize=4.5)
    axes.set_xlim(-0.03, 1.03)
