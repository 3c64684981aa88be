"""Error of one component over the arrival probability [packet_delays Figs. 1-2]."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from repro.papers.packet_delays.points import FIGURES_1_2, LINEAR, linear_points
from repro.plot import style
from repro.plot.style import BAND
from repro.plot.sweep import running, sweep
from repro.tables.results import Results


def error_over_arrival_probability(results: Results, component: str) -> Figure:
    """RMS error of the filters with its band, and the error that the OMVF claims to have."""
    points = linear_points(results)
    drawn, (axes, excess) = style.figure(
        2, 1, size=(7.0, 6.2), sharex=True, gridspec_kw={"height_ratios": [2, 1]}
    )
    sweep(axes, results, LINEAR, points, "rmse", component, filters=FIGURES_1_2)
    table = results.table(LINEAR)
    claimed = table[
        (table["filter"] == "omvf")
        & (table["metric"] == "claimed_mse")
        & (table["component"] == component)
    ].set_index("point")
    axes.plot(
        list(points),
        np.sqrt(claimed.loc[list(points.values()), "value"]),
        color=style.look(results, "omvf")["color"],
        ls="--",
        lw=1.1,
        label="OMVF's own claim, root of its P(k|k)",
    )
    trials = int(claimed["trials"].iloc[0])
    last = results.curves(LINEAR)["k"].max()
    axes.set(
        ylabel=f"RMS error of {component[0]}$_{component[1]}$ over k = 1 ... {last}",
        title=f"Bands: ±{BAND:g} Monte Carlo standard errors, {trials} runs",
    )
    axes.legend(fontsize=8)
    _draw_excess(excess, results, points, component)
    return drawn


def _draw_excess(axes: Axes, results: Results, points: dict[float, str], component: str) -> None:
    """How far each filter is above the exact LMMSE filter on the same runs."""
    table = results.table(LINEAR)
    table = table[(table["metric"] == "rmse") & (table["component"] == component)]
    by_filter = table.pivot(index="point", columns="filter", values="value")
    for filter_, on in running(results, LINEAR, points, FIGURES_1_2).items():
        here = by_filter.loc[list(on.values())]
        percent = 100 * (here[filter_] / here["sun"] - 1)
        axes.plot(list(on), percent, markersize=4, lw=1.3, **style.look(results, filter_))
    axes.set(
        xlabel="packet arrival probability p",
        ylabel="above the exact\nLMMSE filter in %",
        ylim=(-4, 4),
    )
