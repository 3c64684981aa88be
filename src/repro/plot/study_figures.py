"""Figures that every study has, with every filter in them: no script needs to be written."""

from collections.abc import Iterable, Sequence
from textwrap import fill
from typing import Any, NamedTuple

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from repro import plugins
from repro.plot import style
from repro.plot.readings import in_words
from repro.plot.style import BAND
from repro.tables.results import Results

PANELS = 6  # that a figure has at most
COLUMNS = 3
TITLE = 28  # characters of a panel's title on a line
LABELS = 95  # characters of the legend on a line
MARKERS = 6  # on a curve with many points
NO_SWEEP = "no family of points of this study sweeps a number"


class Sweep(NamedTuple):
    """Points that differ in one number."""

    title: str
    key: str  # what is swept
    points: dict[float, str]  # by value, rising


def over_k(results: Results, study: str) -> Figure:
    """Error over the steps, one panel a point of the first family, with a Monte Carlo band."""
    table = results.error_over_k(study)
    points = _first_points(results, study)
    drawn, grid = _panels(points)
    for axes, point in zip(grid, points, strict=True):
        names = results.filters(study, point)
        for place, filter_ in enumerate(names):
            rows = table[(table["point"] == point) & (table["filter"] == filter_)]
            _curve(axes, results, filter_, rows["k"], rows["value"], place / len(names))
            _band(axes, results, filter_, rows["k"], rows["value"], rows["mcse"])
        style.error_axis(axes, "y")
        axes.set_xlabel("k (steps)")
    _label_left(grid, f"error{_unit(study)}")
    return _finished(drawn, grid, f"{_title(results, study)}; bands: ±{BAND:g} standard errors")


def over_sweep(results: Results, study: str) -> Figure:
    """Error over a swept parameter, one panel a family and each other swept value."""
    table = results.ranking_table(study)
    sweeps = _sweeps(results, study)[:PANELS]
    drawn, grid = _panels([sweep.title for sweep in sweeps] or [""])
    if not sweeps:
        grid[0].annotate(NO_SWEEP, (0.5, 0.5), xycoords="axes fraction", ha="center")
        grid[0].axis("off")
        return drawn
    for axes, (_, key, points) in zip(grid, sweeps, strict=True):
        names = dict.fromkeys(f for p in points.values() for f in results.filters(study, p))
        for filter_ in names:
            rows = table[table["filter"] == filter_].set_index("point")
            there = {value: point for value, point in points.items() if point in rows.index}
            rows = rows.loc[list(there.values())]
            _curve(axes, results, filter_, list(there), rows["error"])
            _band(axes, results, filter_, list(there), rows["error"], rows["mcse"])
        style.error_axis(axes, "y")
        style.number_axis(axes, list(points), "x")
        axes.set_xlabel(key.replace("_", " ").replace(".", ": "))
    _label_left(grid, f"error{_unit(study)}, mean over k")
    return _finished(drawn, grid, f"{_title(results, study)}; bands: ±{BAND:g} standard errors")


def distribution(results: Results, study: str) -> Figure:
    """Share of the runs whose error is at most a value, one panel a point of the first family."""
    table = results.error_shares(study)
    points = _first_points(results, study)
    drawn, grid = _panels(points)
    for axes, point in zip(grid, points, strict=True):
        names = results.filters(study, point)
        for place, filter_ in enumerate(names):
            rows = table[(table["point"] == point) & (table["filter"] == filter_)]
            _curve(axes, results, filter_, rows["error"], rows["share"], place / len(names))
        style.error_axis(axes, "x")
        axes.set(xlabel=f"error of a run{_unit(study)}", ylim=(0, 1))
    _label_left(grid, "share of the runs")
    return _finished(drawn, grid, _title(results, study))


def _first_points(results: Results, study: str) -> list[str]:
    """The points of the study's first family, spread over it if they are more than the panels."""
    points = results.points(study)
    first = next(iter(points.values()))["family"]
    chosen = [point for point, at in points.items() if at["family"] == first]
    if len(chosen) > PANELS:
        chosen = [chosen[i] for i in np.linspace(0, len(chosen) - 1, PANELS).round().astype(int)]
    return chosen


def _panels(titles: Sequence[str]) -> tuple[Figure, list[Axes]]:
    """A figure with one panel a title."""
    number = len(titles)
    columns = min(number, COLUMNS)
    rows = -(-number // columns)
    size = (style.WIDTH, 2.4 * rows + 0.9 if number > 1 else 4.6)
    drawn, grid = style.figure(rows, columns, size=size, squeeze=False)
    for axes in grid.flat[number:]:
        axes.remove()
    for axes, title in zip(grid.flat, titles, strict=False):
        axes.set_title(fill(in_words(title), TITLE), fontsize=9)
    return drawn, list(grid.flat[:number])


def _sweeps(results: Results, study: str) -> list[Sweep]:
    """Every family that sweeps a number over three points or more; the longest sweeps first.

    Families keep their order.
    """
    groups: dict[tuple, dict[float, str]] = {}
    for point, at in results.points(study).items():
        for key, value in at["swept"].items():
            if isinstance(value, int | float) and not isinstance(value, bool):
                others = tuple((k, str(v)) for k, v in at["swept"].items() if k != key)
                groups.setdefault((at["family"], key, others), {})[value] = point
    families = list(dict.fromkeys(family for family, *_ in groups))
    return [
        Sweep(_sweep_title(family, key, others), key, dict(sorted(points.items())))
        for (family, key, others), points in sorted(
            groups.items(), key=lambda group: (families.index(group[0][0]), -len(group[1]))
        )
        if len(points) > 2
    ]


def _sweep_title(family: str, key: str, others: Iterable[tuple[str, str]]) -> str:
    """What the points have in common: their names, where * is swept, or the other swept values."""
    values = ", ".join(f"{name.replace('_', ' ')} = {value}" for name, value in others)
    return values or family.replace(f"{{{key}}}", "*")


def _curve(axes: Axes, results: Results, filter_: str, x: Any, y: Any, offset: float = 0.0) -> None:
    """A filter's line, with a few markers: `offset`, from 0 to 1, keeps those of others apart."""
    step = max(len(y) // MARKERS, 1)
    label = style.label(filter_)
    if np.all(np.asarray(x) == 0) or np.all(np.asarray(y) == 0):
        label += " (error 0)"  # not on a logarithmic axis
    axes.plot(
        x,
        y,
        ms=4,
        lw=1.3,
        label=label,
        markevery=(int(offset * step), step),
        **style.look(results, filter_),
    )


def _band(axes: Axes, results: Results, filter_: str, x: Any, value: Any, mcse: Any) -> None:
    style.band(axes, x, value, mcse, style.look(results, filter_)["color"])


def _unit(study: str) -> str:
    unit = plugins.study(study).error_unit
    return f" in {unit}" if unit else ""


def _title(results: Results, study: str) -> str:
    trials = sorted(set(results.ranking_table(study)["trials"]))
    runs = f"{trials[0]} to {trials[-1]}" if len(trials) > 1 else f"{trials[0]}"
    return f"{study}: every filter, {runs} runs"


def _label_left(grid: Sequence[Axes], label: str) -> None:
    for axes in grid[::COLUMNS]:
        axes.set_ylabel(label)


def _finished(drawn: Figure, grid: Sequence[Axes], title: str) -> Figure:
    """With title, and one legend for all panels, below them."""
    handles: dict[str, Any] = {}
    for axes in grid:
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True):
            handles.setdefault(label, handle)
    longest = max(map(len, handles)) + 8  # characters, with the line before the label
    per_row = max(min(LABELS // longest, len(handles)), 1)
    drawn.legend(
        handles.values(), handles.keys(), fontsize=8, ncols=per_row, loc="outside lower center"
    )
    drawn.suptitle(title, fontsize=10)
    return drawn
