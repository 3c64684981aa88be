"""Error of one component over the arrival probability [packet_delays Figs. 1-2]."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from repro.papers.packet_delays.claims.errors import squared_error
from repro.papers.packet_delays.points import FIGURES_1_2, LINEAR, linear_points
from repro.plot import style
from repro.plot.style import BAND
from repro.plot.sweep import running, sweep
from repro.statistics.metrics import jackknife_error, root
from repro.studies import linear_delays
from repro.tables.results import Results

SHIFT = 0.006  # between the filters at a p, so that no bar hides another


def error_over_arrival_probability(results: Results, component: str) -> Figure:
    """RMS error of the filters with its band, and the error that the OMVF claims to have."""
    points = linear_points(results)
    drawn, (axes, excess) = style.figure(
        2, 1, size=(style.WIDTH, 7.0), sharex=True, gridspec_kw={"height_ratios": [1.3, 1]}
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
        title=f"{trials} runs; bands: ±{BAND:g} standard errors",
    )
    axes.legend(fontsize=8)
    _draw_excess(excess, results, points, component)
    return drawn


def _draw_excess(axes: Axes, results: Results, points: dict[float, str], component: str) -> None:
    """How far each filter is above the exact LMMSE filter on the same runs, with paired errors."""
    place = linear_delays.COMPONENTS.index(component)
    optimal = {p: root(squared_error(results, p, "sun", place)) for p in points.values()}
    shown = [name for name in FIGURES_1_2 if name != "sun"]
    drawn = running(results, LINEAR, points, shown)
    for i, (filter_, on) in enumerate(drawn.items()):
        excess, error = [], []
        for point in on.values():
            ours, best = root(squared_error(results, point, filter_, place)), optimal[point]
            excess.append(100 * (ours.value / best.value - 1))
            error.append(100 * jackknife_error(ours.left_out / best.left_out))
        at = np.array(list(on)) + SHIFT * (i - (len(drawn) - 1) / 2)
        length = BAND * np.array(error)
        look = style.look(results, filter_)
        axes.errorbar(at, excess, length, ms=4, lw=1.0, elinewidth=1.3, capsize=2, **look)
    axes.axhline(0, color=style.look(results, "sun")["color"], lw=1.3)
    axes.set(
        xlabel="packet arrival probability p",
        ylabel="above the exact\nLMMSE filter in %",
        ylim=(-4, 4),
        title=f"Bars: ±{BAND:g} standard errors of the paired difference",
    )
    axes.title.set_fontsize(9.5)
