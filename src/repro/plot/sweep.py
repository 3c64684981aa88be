"""A statistic of every filter over a swept parameter, with its Monte Carlo band."""

from matplotlib.axes import Axes

from repro.plot import style
from repro.plot.style import BAND
from repro.tables.results import Results


def sweep(
    axes: Axes,
    results: Results,
    study: str,
    points: dict[float, str],
    metric: str,
    component: str,
    names: dict[str, str] | None = None,
) -> None:
    """Draw one line a filter: `points` maps the swept value to the point's name.

    `names` are the filters' names in this figure, where they differ from their labels.
    """
    table = results.table(study)
    table = table.loc[(table["metric"] == metric) & (table["component"] == component)]
    values = list(points)
    for filter_ in results.filters(study, points[values[0]]):
        rows = table.loc[table["filter"] == filter_].set_index("point").loc[list(points.values())]
        look = style.look(results, filter_)
        label = (names or {}).get(filter_, style.label(filter_))
        axes.plot(values, rows["value"], label=label, markersize=4, lw=1.3, **look)
        axes.fill_between(
            values,
            rows["value"] - BAND * rows["mcse"],
            rows["value"] + BAND * rows["mcse"],
            color=look["color"],
            alpha=0.2,
            lw=0,
        )
