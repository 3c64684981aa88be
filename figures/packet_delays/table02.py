"""Table 2: SAEE of the EMVF by N and p, published and reproduced."""

import numpy as np

from repro.plot import style

NEEDS = {"tables": ["wsn_tracking"], "diff": True}
CAPTION = (
    "Table 2. SAEE of the EMVF, published and ours, each with its standard error (theirs from our "
    "spread at their 300 runs), our medians, and the parameters as printed. The level was fitted "
    "through q: agreement of levels is a fit, not a prediction."
)


def draw(results):
    table = results.table("wsn_tracking")
    table = table[(table["filter"] == "emvf") & (table["metric"] == "saee")].set_index("point")
    diff = results.diff()
    diff = diff[diff["item"].str.startswith("Table 2")].set_index("point")
    drawn, grid = style.figure(1, 3, size=(9.0, 3.6), sharey=True)
    for bound, axes in enumerate(grid):
        points = [f"n{bound}-arrival={p}" for p in (0.8, 0.85, 0.9, 0.95, 0.99)]
        place = np.arange(len(points))
        theirs, ours = diff.loc[points], table.loc[points]
        axes.errorbar(
            place - 0.1,
            theirs["published"],
            theirs["their_error"],
            fmt="_",
            color="black",
            ms=11,
            capsize=3,
            label="published",
        )
        axes.errorbar(
            place + 0.1,
            ours["value"],
            ours["mcse"],
            fmt="o",
            color=style.COLOURS[0],
            capsize=3,
            label="ours",
        )
        axes.plot(place + 0.1, ours["median"], "x", color=style.COLOURS[0], label="our median")
        printed = [f"as-printed-{point}" for point in points]
        known = [i for i, point in enumerate(printed) if point in table.index]
        axes.plot(
            place[known],
            table.loc[[printed[i] for i in known], "median"],
            "s",
            mfc="none",
            color=style.COLOURS[1],
            label="median, parameters as printed",
        )
        axes.set(
            title=f"N = {bound}",
            xticks=place,
            xticklabels=[p.split("=")[1] for p in points],
            xlabel="packet arrival probability p",
            yscale="log",
        )
    grid[0].set_ylabel("SAEE in m")
    grid[0].legend(fontsize=7)
    return drawn
