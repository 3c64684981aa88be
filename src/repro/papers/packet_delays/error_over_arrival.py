"""Figures 1 and 2 of Liu, Xu, Shi 2012: error of one component over the arrival probability."""

import numpy as np
from matplotlib.figure import Figure

from repro.plot import style
from repro.plot.sweep import sweep
from repro.tables.results import Results

STUDY = "linear_delays"


def error_over_arrival_probability(results: Results, component: str) -> Figure:
    """RMS error of every filter with its band, and the error that the OMVF claims to have."""
    points = {
        float(point.removeprefix("arrival=")): point
        for point in results.catalogue[STUDY]
        if point.startswith("arrival=")
    }
    drawn, (axes, excess) = style.figure(
        2, 1, size=(7.0, 6.2), sharex=True, gridspec_kw={"height_ratios": [2, 1]}
    )
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
        ylabel=f"RMS error of {component[0]}$_{component[1]}$ over k = 1 ... 300",
        title=f"Bands: ±2 Monte Carlo standard errors, {trials} runs",
    )
    axes.legend(fontsize=8)
    _draw_excess(excess, results, list(points.values()), list(points), component)
    return drawn


def _draw_excess(axes, results, points, values, component) -> None:
    """How far each filter is above the exact LMMSE filter on the same runs."""
    table = results.table(STUDY)
    table = table[(table["metric"] == "rmse") & (table["component"] == component)]
    by_filter = table.pivot(index="point", columns="filter", values="value").loc[points]
    for filter_ in results.filters(STUDY, points[0]):
        look = style.look(results.catalogue, STUDY, filter_)
        percent = 100 * (by_filter[filter_] / by_filter["sun"] - 1)
        axes.plot(values, percent, markersize=4, lw=1.3, **look)
    axes.set(
        xlabel="packet arrival probability p",
        ylabel="above the exact\nLMMSE filter in %",
        ylim=(-4, 4),
    )
