"""What the choices that the paper leaves open change: RMSE of the filters under each reading."""

import numpy as np
from matplotlib.figure import Figure

from repro.plot import style
from repro.plot.sweep import BAND
from repro.tables.results import Results

NEEDS = {"tables": ["rss_2d", "ungm"]}
CAPTION = (
    "RMSE (mean over k) under one changed assumption at a time, with its band: position in the "
    "plane on the left, the scalar example on the right. Crosses are median runs."
)


def draw(results: Results) -> Figure:
    drawn, grid = style.figure(1, 2, size=(10.6, 5.6))
    for axes, study, component, unit in zip(
        grid, ("rss_2d", "ungm"), ("position", "state"), (" in m", ""), strict=True
    ):
        table = results.table(study)
        table = table.loc[(table["metric"] == "rmse") & (table["component"] == component)]
        points = [p for p in results.catalogue[study] if p == "base" or p.startswith("reading-")]
        filters = results.filters(study, "base")
        for filter_ in filters:
            rows = table.loc[table["filter"] == filter_].set_index("point")
            place = [i for i, point in enumerate(points) if point in rows.index]
            rows = rows.loc[[points[i] for i in place]]
            shift = 0.11 * (filters.index(filter_) - (len(filters) - 1) / 2)
            look = style.look(results, filter_)
            at = np.array(place) + shift
            axes.errorbar(
                rows["value"],
                at,
                xerr=BAND * rows["mcse"],
                ls="none",
                ms=4,
                lw=1,
                **look,
                label=style.label(filter_),
            )
            axes.plot(rows["median"], at, "x", ms=4, color=look["color"], alpha=0.6)
        axes.set(
            yticks=np.arange(len(points)),
            yticklabels=[point.removeprefix("reading-") for point in points],
            xscale="log" if study == "rss_2d" else "linear",
            xlabel=f"{component} RMSE{unit}, {study}",
        )
        axes.invert_yaxis()
        axes.legend(fontsize=7, ncols=3, loc="upper center", bbox_to_anchor=(0.4, 1.13))
    return drawn
