"""Effect of the choices that the paper leaves open, on the radar at p = 0.5."""

import numpy as np
from matplotlib.figure import Figure

from repro.papers.unknown_losses.points import PICTURED
from repro.plot import style
from repro.plot.sweep import running
from repro.tables.results import Results

NEEDS = {"tables": ["radar"]}
CAPTION = (
    "Position RMSE on the radar at p = 0.5 under one changed assumption at a time: RMSE with "
    "its standard error, and the median of the single runs (crosses). figures/studies/radar has "
    "every filter."
)
BASE = "loss=0.5"
SPREAD = 0.68  # of the filters at a point; points are 1 apart


def draw(results: Results) -> Figure:
    table = results.table("radar")
    table = table.loc[table["metric"] == "rmse"]
    points = [BASE, *(p for p in results.catalogue["radar"] if p.startswith("reading-"))]
    drawn, axes = style.figure(size=(7.8, 4.6))
    drawn_on = running(results, "radar", dict(enumerate(points)), PICTURED["radar"])
    for i, (filter_, on) in enumerate(drawn_on.items()):
        rows = table.loc[table["filter"] == filter_].set_index("point").loc[list(on.values())]
        place = np.array(list(on)) + SPREAD / len(drawn_on) * (i - (len(drawn_on) - 1) / 2)
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
