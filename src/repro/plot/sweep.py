"""A statistic of several filters over a swept parameter, with its Monte Carlo band."""

from collections.abc import Iterable, Mapping
from typing import TypeVar

from matplotlib.axes import Axes

from repro.plot import style
from repro.tables.results import Results

Value = TypeVar("Value", bound=float)  # of the swept parameter


def running(
    results: Results, study: str, points: Mapping[Value, str], filters: Iterable[str] | None = None
) -> dict[str, dict[Value, str]]:
    """Those of `points` (swept value -> name) that a filter runs on, by filter.

    The filters are those given and a reader's own, as far as they run on any; all if none is given.
    """
    every = (f for point in points.values() for f in results.filters(study, point))
    wanted = dict.fromkeys(every if filters is None else (*filters, *results.own_filters))
    on_points = {
        name: {at: p for at, p in points.items() if name in results.filters(study, p)}
        for name in wanted
    }
    return {name: where for name, where in on_points.items() if where}


def sweep(
    axes: Axes,
    results: Results,
    study: str,
    points: dict[float, str],
    metric: str,
    component: str,
    names: dict[str, str] | None = None,
    filters: Iterable[str] | None = None,
    log: bool = False,
) -> None:
    """Draw one line a filter: `points` maps the swept value to the point's name.

    `names` are the filters' names in this figure, where they differ from their labels; `filters`
    those that are drawn besides a reader's own (default: all); `log` tells the bands that the axis
    is logarithmic.
    """
    table = results.table(study)
    table = table.loc[(table["metric"] == metric) & (table["component"] == component)]
    for filter_, on in running(results, study, points, filters).items():
        values = list(on)
        rows = table.loc[table["filter"] == filter_].set_index("point").loc[list(on.values())]
        look = style.look(results, filter_)
        label = (names or {}).get(filter_, style.label(filter_))
        axes.plot(values, rows["value"], label=label, markersize=4, lw=1.3, **look)
        style.band(axes, values, rows["value"], rows["mcse"], look["color"], log)
