"""Table 2: SAEE of the EMVF by N and p, published and reproduced, and of a reader's own filters."""

from typing import Any

import numpy as np
from matplotlib.figure import Figure

from repro.papers.packet_delays.points import TRACKING, table_2, tracking_point
from repro.plot import style
from repro.tables.results import Results

NEEDS = {"tables": ["wsn_tracking"], "diff": True}
CAPTION = (
    "Redrawing of Table 2: SAEE of the EMVF, published and ours, each with bars of two standard "
    "errors (theirs is our spread at their number of runs), our medians, and the medians with the "
    "parameters as printed. The level was fitted through q: that the levels agree is a fit, not a "
    "prediction. Every filter: figures/studies/wsn_tracking."
)


def draw(results: Results) -> Figure:
    saee = results.table(TRACKING)
    saee = saee[saee["metric"] == "saee"]
    table = saee[saee["filter"] == "emvf"].set_index("point")
    diff = results.diff()
    diff = diff[(diff["study"] == TRACKING) & (diff["metric"] == "saee")].set_index("point")
    bounds = table_2(results)
    drawn, grid = style.figure(1, len(bounds), size=(style.WIDTH, 3.9), sharey=True)
    for (bound, arrivals), axes in zip(bounds.items(), grid, strict=True):
        points = [tracking_point(bound, arrival) for arrival in arrivals]
        place = np.arange(len(points))
        theirs, ours = diff.loc[points], table.loc[points]
        axes.errorbar(
            place - 0.1,
            theirs["published"],
            style.bars(theirs["published"], theirs["their_error"]),
            fmt="_",
            color="black",
            ms=11,
            capsize=3,
            label="published",
        )
        axes.errorbar(
            place + 0.1,
            ours["value"],
            style.bars(ours["value"], ours["mcse"]),
            fmt="o",
            color=style.look(results, "emvf")["color"],
            capsize=3,
            label="ours",
        )
        axes.plot(
            place + 0.1,
            ours["median"],
            "x",
            color=style.look(results, "emvf")["color"],
            label="our median",
        )
        for shift, filter_ in enumerate(results.own_filters, start=2):
            rows = saee[saee["filter"] == filter_].set_index("point")
            there = [i for i, point in enumerate(points) if point in rows.index]
            rows = rows.loc[[points[i] for i in there]]
            beside, look = place[there] + 0.1 * shift, style.look(results, filter_)
            if there:
                axes.errorbar(
                    beside,
                    rows["value"],
                    style.bars(rows["value"], rows["mcse"]),
                    **look,
                    ls="none",
                    capsize=3,
                    label=style.label(filter_),
                )
                axes.plot(beside, rows["median"], "x", color=look["color"])
        printed = [f"reading-as_printed@{point}" for point in points]
        known = [i for i, point in enumerate(printed) if point in table.index]
        axes.plot(
            place[known],
            table.loc[[printed[i] for i in known], "median"],
            "s",
            mfc="none",
            color="0.4",
            label="median, parameters as printed",
        )
        axes.set(
            title=f"N = {bound}, {_runs(ours)} runs",
            xticks=place,
            xticklabels=arrivals,
            xlabel="packet arrival probability p",
            yscale="log",
        )
    grid[0].set_ylabel("SAEE in m")
    labelled: dict[str, Any] = {}
    for axes in grid:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            labelled.setdefault(label, handle)
    drawn.legend(
        labelled.values(), labelled.keys(), fontsize=8, ncols=3, loc="outside lower center"
    )
    return drawn


def _runs(rows: Any) -> str:
    """Of the points, which may differ in it."""
    trials = sorted(set(rows["trials"]))
    return f"{trials[0]}" if len(trials) == 1 else f"{trials[0]} to {trials[-1]}"
