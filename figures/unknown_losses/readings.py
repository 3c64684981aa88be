"""Effect of the choices that the paper leaves open, on the radar at p = 0.5."""

import numpy as np
from matplotlib.figure import Figure

from repro.papers.unknown_losses.points import PICTURED, rbpf_of
from repro.parameters.point_names import OF
from repro.plot import style
from repro.tables.results import Results

NEEDS = {"tables": ["radar"]}
CAPTION = (
    "Position RMSE on the radar at p = 0.5 under one changed assumption at a time: RMSE with "
    "its standard error, and the median of the single runs (crosses). Beside the paper's filters "
    "the EKF that takes every value for a measurement. figures/studies/radar has every filter."
)
BASE = "loss=0.5"
NAMES = {"iekf": "IEKF", "ekf": "EKF, losses ignored"}
SPREAD = 0.68  # of the filters at a point; points are 1 apart


def draw(results: Results) -> Figure:
    table = results.table("radar")
    table = table.loc[table["metric"] == "rmse"].set_index(["point", "filter"])
    points = [BASE, *(p for p in results.catalogue["radar"] if p.endswith(OF + BASE))]
    filters = [*PICTURED["radar"], "ekf", *results.own_filters]
    drawn, axes = style.figure(size=(7.8, 6.2))
    for i, filter_ in enumerate(filters):
        ran = {}  # place on the axis -> point and filter
        for j, point in enumerate(points):
            name = rbpf_of(results.catalogue, "radar", point) if filter_ == "rbpf" else filter_
            if name in results.filters("radar", point):
                ran[j + SPREAD / len(filters) * (i - (len(filters) - 1) / 2)] = (point, name)
        if not ran:
            continue
        rows, color = table.loc[list(ran.values())], style.look(results, filter_)["color"]
        axes.errorbar(
            rows["value"],
            list(ran),
            xerr=rows["mcse"],
            fmt="o",
            ms=4,
            color=color,
            capsize=2,
            label=NAMES.get(filter_, style.label(filter_)),
        )
        axes.plot(rows["median"], list(ran), "x", ms=5, color=color)
    readings = (p.removeprefix("reading-").removesuffix(OF + BASE) for p in points[1:])
    axes.plot([], [], "kx", label="median")
    axes.set(yticks=np.arange(len(points)), yticklabels=[f"base, {BASE}", *readings], xscale="log")
    axes.set_xlabel("position RMSE in m, mean over the steps")
    axes.invert_yaxis()
    axes.legend(fontsize=8, ncols=3, loc="lower center", bbox_to_anchor=(0.5, 1.0))
    return drawn
