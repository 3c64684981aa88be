"""How the errors of the runs of a heavy-tailed study are distributed, and which run is shown."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from repro import plugins
from repro.plot import style
from repro.tables.results import Results
from repro.tables.tails import run_errors


class Panel(NamedTuple):
    """A point of a study, and the runs of it that figures of single runs show."""

    study: str
    point: str
    shown: dict[str, int]  # what to call it -> number of the run
    filters: Sequence[str]  # of which those figures show the run


def tails(results: Results, panels: Sequence[Panel]) -> Figure:
    """Share of the runs whose error is larger, one line a filter; a cross for each shown run.

    The error of a run is the mean over k of its error.
    """
    columns = min(len(panels), 2)
    rows = -(-len(panels) // columns)
    drawn, grid = style.figure(rows, columns, size=(7.7, 3.3 * rows + 0.6), squeeze=False)
    for axes in grid.flat[len(panels) :]:
        axes.remove()
    for axes, panel in zip(grid.flat, panels, strict=False):
        _draw(axes, results, panel)
    return drawn


def _draw(axes: Axes, results: Results, panel: Panel) -> None:
    scenario = plugins.study(panel.study)
    for filter_ in results.filters(panel.study, panel.point):
        squared = results.each(panel.study, panel.point, filter_, scenario.squared_error)
        errors = run_errors(squared)
        if not errors.any():  # starts on the truth and needs no data
            continue
        larger = 1.0 - np.arange(len(errors)) / len(errors)  # of the runs, or as large
        colour, label = style.look(results, filter_)["color"], style.label(filter_)
        for name, run in panel.shown.items() if filter_ in panel.filters else ():
            share = float((errors >= errors[run]).mean())
            axes.plot(errors[run], share, "x", color=colour, ms=8, mew=2, zorder=4)
            label += f" ({name}: quantile {1.0 - share:.2f})"
        axes.step(np.sort(errors), larger, where="pre", lw=1.3, label=label, color=colour)
    axes.set(
        yscale="log",
        xlabel=f"error of a run in {scenario.error_unit}, mean over k",
        ylabel="share of the runs with a larger error",
    )
    style.error_axis(axes, "x")
    axes.set_title(f"{panel.study}, {panel.point}", fontsize=9.5)
    axes.legend(
        fontsize=7, loc="lower left", bbox_to_anchor=(0.0, 0.0), framealpha=0.85, frameon=True
    )
