"""Figures 1 and 2 of Liu, Xu, Shi 2012: error of one component over the arrival probability."""

import numpy as np
from matplotlib.figure import Figure

from repro.plot import style
from repro.plot.sweep import sweep
from repro.results import Results

STUDY = "linear_delays"


def error_over_arrival_probability(results: Results, component: str) -> Figure:
    """RMS error of every filter with its band, and the error that the OMVF claims to have."""
    points = {
        float(point.removeprefix("arrival=")): point
        for point in results.catalogue[STUDY]
        if point.startswith("arrival=")
    }
    drawn, axes = style.figure()
    sweep(axes, results, STUDY, points, "rmse", component)
    table = results.table(STUDY)
    claimed = table[
        (table["filter"] == "omvf")
        & (table["metric"] == "claimed_mse")
        & (table["component"] == component)
    ].set_index("point")
    axes.plot(
        list(points),
        np.sqrt(claimed.loc[list(points.values()), "value"]),
        color=style.look(results.catalogue, STUDY, "omvf")["color"],
        ls="--",
        lw=1.1,
        label="OMVF's own claim, root of its P(k|k)",
    )
    trials = int(claimed["trials"].iloc[0])
    axes.set(
        xlabel="packet arrival probability p",
        ylabel=f"RMS error of {component[0]}$_{component[1]}$ over k = 1 ... 300",
        title=f"Bands: ±2 Monte Carlo standard errors, {trials} runs",
    )
    axes.legend(fontsize=8)
    return drawn
