"""A statistic of the filters over a swept parameter, with its Monte Carlo band."""

from collections.abc import Iterable

from matplotlib.axes import Axes

from repro.plot import style
from repro.plot.style import BAND
from repro.tables.results import Results


def on_any(
    results: Results, study: str, points: Iterable[str], filters: Iterable[str]
) -> list[str]:
    """The named filters and a reader's own that run on any of the points."""
    found = {f for point in points for f in results.filters(study, point)}
    return [f for f in (*filters, *results.own_filters) if f in found]


def sweep(
    axes: Axes,
    results: Results,
    study: str,
    points: dict[float, str],
    metric: str,
    component: str,
    names: dict[str, str] | None = None,
    filters: Iterable[str] | None = None,
) -> None:
    """Draw one line a filter: `points` maps the swept value to the point's name.

    `names` are the filters' names in this figure, where they differ from their labels. `filters`
    are those of the published figure; by default the ones that run on every point, but for the
    one that uses no measurement. A reader's own are drawn on the points that they run on.
    """
    table = results.table(study)
    table = table.loc[(table["metric"] == metric) & (table["component"] == component)]
    if filters is None:
        filters = _on_all(results, study, list(points.values()))
    for filter_ in on_any(results, study, points.values(), filters):
        rows = table.loc[table["filter"] == filter_].set_index("point")
        there = {value: point for value, point in points.items() if point in rows.index}
        rows = rows.loc[list(there.values())]
        look = style.look(results, filter_)
        label = (names or {}).get(filter_, style.label(filter_))
        axes.plot(list(there), rows["value"], label=label, markersize=4, lw=1.3, **look)
        axes.fill_between(
            list(there),
            rows["value"] - BAND * rows["mcse"],
            rows["value"] + BAND * rows["mcse"],
            color=look["color"],
            alpha=0.2,
            lw=0,
        )


def _on_all(results: Results, study: str, points: list[str]) -> list[str]:
    left_out = {results.ranking(study).nothing, *results.own_filters}
    return [
        f
        for f in results.filters(study, points[0])
        if f not in left_out and all(f in results.filters(study, point) for point in points)
    ]
