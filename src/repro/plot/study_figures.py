"""Figures that every study has, with every filter in them: no script needs to be written."""

from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from repro import plugins
from repro.plot import style
from repro.plot.style import BAND
from repro.tables.results import Results

PANELS = 6  # points that a figure has at most
COLUMNS = 3
NO_SWEEP = "no family of this study sweeps a number"


def over_k(results: Results, study: str) -> Figure:
    """Error over the steps, one panel a point of the first family, with a Monte Carlo band."""
    table = results.error_over_k(study)
    drawn, panels = _panels(results, study)
    for axes, point in panels:
        for filter_ in results.filters(study, point):
            rows = table[(table["point"] == point) & (table["filter"] == filter_)]
            look = style.look(results, filter_)
            axes.plot(
                rows["k"], rows["value"], lw=1.3, color=look["color"], label=style.label(filter_)
            )
            _band(axes, rows["k"], rows["value"], rows["mcse"], look["color"])
        axes.set(xlabel="k (steps)", yscale="log")
    return _finished(drawn, panels, results, study, "error over the steps")


def over_sweep(results: Results, study: str) -> Figure:
    """Error over a swept parameter, one panel a family and each other swept value."""
    table = results.ranking_table(study)
    sweeps = _sweeps(results, study)[:PANELS]
    drawn, grid = _grid(max(len(sweeps), 1))
    if not sweeps:
        grid[0].annotate(NO_SWEEP, (0.5, 0.5), xycoords="axes fraction", ha="center")
        grid[0].axis("off")
        return drawn
    for axes, (title, key, points) in zip(grid, sweeps, strict=True):
        names = dict.fromkeys(f for p in points.values() for f in results.filters(study, p))
        for filter_ in names:
            rows = table[table["filter"] == filter_].set_index("point")
            here = [(value, point) for value, point in points.items() if point in rows.index]
            values, chosen = [value for value, _ in here], rows.loc[[point for _, point in here]]
            look = style.look(results, filter_)
            axes.plot(values, chosen["error"], ms=4, lw=1.3, label=style.label(filter_), **look)
            _band(axes, values, chosen["error"], chosen["mcse"], look["color"])
        axes.set(xlabel=key.replace("_", " "), yscale="log")
        axes.set_title(title, fontsize=9)
    panels = list(zip(grid, sweeps, strict=True))
    return _finished(drawn, panels, results, study, "error, mean over the steps")


def distribution(results: Results, study: str) -> Figure:
    """Share of the runs whose error is at most a value, one panel a point of the first family."""
    table = results.error_shares(study)
    drawn, panels = _panels(results, study)
    for axes, point in panels:
        for filter_ in results.filters(study, point):
            rows = table[(table["point"] == point) & (table["filter"] == filter_)]
            look = style.look(results, filter_)
            axes.plot(
                rows["error"],
                rows["share"],
                lw=1.3,
                color=look["color"],
                label=style.label(filter_),
            )
        axes.set(ylabel="share of the runs", ylim=(0, 1), xscale="log")
    unit = _unit(study)
    for axes, _ in panels:
        axes.set_xlabel(f"error of a run{unit}")
    return _finished(drawn, panels, results, study, None)


def _panels(results: Results, study: str) -> tuple[Figure, list[tuple[Axes, str]]]:
    """A figure with one panel for each of the first points of the study's first family."""
    points = results.points(study)
    first = next(iter(points.values()))["family"]
    chosen = [
        p for p, at in points.items() if at["family"] == first and p in results.catalogue[study]
    ]
    if len(chosen) > PANELS:  # spread over the sweep
        chosen = [chosen[i] for i in np.linspace(0, len(chosen) - 1, PANELS).round().astype(int)]
    drawn, grid = _grid(len(chosen))
    for axes, point in zip(grid, chosen, strict=True):
        axes.set_title(point, fontsize=9)
    return drawn, list(zip(grid, chosen, strict=True))


def _grid(number: int) -> tuple[Figure, list[Axes]]:
    columns = min(number, COLUMNS)
    rows = -(-number // columns)
    size = (3.6 * columns + 1.6, 2.9 * rows + 0.5)
    drawn, grid = style.figure(rows, columns, size=size, squeeze=False)
    for axes in grid.flat[number:]:
        axes.remove()
    return drawn, list(grid.flat[:number])


def _sweeps(results: Results, study: str) -> list[tuple[str, str, dict[float, str]]]:
    """(title, swept key, value -> point) of every family that sweeps a number over three points."""
    groups: dict[tuple, dict[float, str]] = {}
    for point, at in results.points(study).items():
        for key, value in at["swept"].items():
            if isinstance(value, int | float) and not isinstance(value, bool):
                others = tuple((k, str(v)) for k, v in at["swept"].items() if k != key)
                groups.setdefault((at["family"], key, others), {})[value] = point
    return [
        (
            ", ".join(f"{k.replace('_', ' ')} = {v}" for k, v in others),
            key,
            dict(sorted(points.items())),
        )
        for (_, key, others), points in groups.items()
        if len(points) > 2
    ]


def _band(axes: Axes, at: Any, value: pd.Series, mcse: pd.Series, colour: str) -> None:
    """Two standard errors of the logarithm, for a logarithmic axis."""
    factor = np.exp(BAND * mcse / value)
    axes.fill_between(at, value / factor, value * factor, color=colour, alpha=0.18, lw=0)


def _unit(study: str) -> str:
    unit = plugins.study(study).error_unit
    return f" in {unit}" if unit else ""


def _finished(
    drawn: Figure, panels: list, results: Results, study: str, ylabel: str | None
) -> Figure:
    axes = [axes for axes, _ in panels]
    if ylabel:
        for one in axes[::COLUMNS]:
            one.set_ylabel(f"{ylabel}{_unit(study)}")
    handles = {}
    for one in axes:
        for handle, label in zip(*one.get_legend_handles_labels(), strict=True):
            handles.setdefault(label, handle)
    drawn.legend(handles.values(), handles.keys(), fontsize=8, loc="outside right upper")
    trials = results.ranking_table(study)["trials"].max()
    drawn.suptitle(
        f"{study}: every filter, up to {trials} runs; bands ±{BAND} standard errors", fontsize=10
    )
    return drawn
