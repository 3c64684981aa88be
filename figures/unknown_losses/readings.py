"""What the unstated choices are worth on the radar at p = 0.5."""

import numpy as np

from repro.plot import style

NEEDS = {"tables": ["radar"]}
CAPTION = (
    "Position RMSE on the radar at p = 0.5 under one changed assumption at a time: RMSE with "
    "its standard error, and the median of the single runs (crosses)."
)
FILTERS = ("iekf", "bkf_1", "bkf_2", "rbpf")


def draw(results):
    table = results.table("radar")
    table = table[table["metric"] == "rmse"]
    points = ["loss=0.5", *(p for p in table["point"].unique() if p.startswith("reading-"))]
    drawn, axes = style.figure(size=(7.8, 4.6))
    for i, filter_ in enumerate(FILTERS):
        rows = table[table["filter"] == filter_].set_index("point").loc[points]
        place = np.arange(len(points)) + 0.17 * (i - 1.5)
        color = style.look(results.catalogue, "radar", filter_)["color"]
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
    labels = ["base, loss=0.5", *(p.removeprefix("reading-") for p in points[1:])]
    axes.plot([], [], "kx", label="median")
    axes.set(yticks=np.arange(len(points)), yticklabels=labels, xscale="log")
    axes.set_xlabel("position RMSE in m, mean over the steps")
    axes.invert_yaxis()
    axes.legend(fontsize=8)
    return drawn
