"""Effect of the choices that the paper leaves open, on the radar at p = 0.5."""

import numpy as np
from matplotlib.figure import Figure

from repro.papers.unknown_losses.points import proposed_filters
from repro.plot import style
from repro.tables.results import Results

NEEDS = {"tables": ["radar"]}
CAPTION = (
    "Position RMSE on the radar at p = 0.5 under one changed assumption at a time: RMSE with "
    "its standard error, and the median of the single runs (crosses)."
)
BASE = "loss=0.5"


def draw(results: Results) -> Figure:
    table = results.table("radar")
    table = table.loc[table["metric"] == "rmse"]
    points = [BASE, *(p for p in table["point"].unique() if p.startswith("reading-"))]
    drawn, axes = style.figure(size=(7.8, 4.6))
    filters = ("iekf", *proposed_filters(results.catalogue, "radar", BASE))
    for i, filter_ in enumerate(filters):
        rows = table.loc[table["filter"] == filter_].set_index("point").loc[points]
        place = np.arange(len(points)) + 0.17 * (i - 1.5)
        color = style.look(results, filter_)["color"]
        label = "IEKF" if filter_ == "iekf" else style.label(filter_)
        axes.errorbar(
            rows["value"],
            place,
            xerr=rows["mcse"],
            fmt="o",
            ms=4,
            color=color,
            capsize=2,
            label=label,
        )
        axes.plot(rows["median"], place, "x", ms=5, color=color)
    labels = [f"base, {BASE}", *(p.removeprefix("reading-") for p in points[1:])]
    axes.plot([], [], "kx", label="median")
    axes.set(yticks=np.arange(len(points)), yticklabels=labels, xscale="log")
    axes.set_xlabel("position RMSE in m, mean over the steps")
    axes.invert_yaxis()
    axes.legend(fontsize=8)
    return drawn
