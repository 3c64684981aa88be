"""What the choices that the paper leaves open change: RMSE of the filters under each reading."""

import numpy as np
from matplotlib.figure import Figure

from repro.papers.energy_harvesting.compared import EXTENSIONS, PAPERS_FILTERS
from repro.parameters.point_names import reading_of
from repro.plot import style
from repro.plot.sweep import BAND, running
from repro.tables.results import Results

NEEDS = {"tables": ["rss_2d", "ungm"]}
CAPTION = (
    "RMSE (mean over k) under one changed assumption at a time, with its band: position in the "
    "plane on the left, the scalar example on the right. Crosses are median runs. "
    "figures/studies/rss_2d and figures/studies/ungm have every filter."
)
SHIFT = 0.11  # between the filters at a point; points are 1 apart


def draw(results: Results) -> Figure:
    drawn, grid = style.figure(1, 2, size=(10.6, 5.6))
    for axes, study, component, unit in zip(
        grid, ("rss_2d", "ungm"), ("position", "state"), (" in m", ""), strict=True
    ):
        table = results.table(study)
        table = table.loc[(table["metric"] == "rmse") & (table["component"] == component)]
        points = [p for p in results.catalogue[study] if p == "base" or reading_of(p)[1] == "base"]
        named = (*PAPERS_FILTERS, *EXTENSIONS)
        drawn_on = running(results, study, dict(enumerate(points)), named)
        for i, (filter_, on) in enumerate(drawn_on.items()):
            rows = table.loc[table["filter"] == filter_].set_index("point").loc[list(on.values())]
            look = style.look(results, filter_)
            at = np.array(list(on)) + SHIFT * (i - (len(drawn_on) - 1) / 2)
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
            yticklabels=[reading_of(point)[0].removeprefix("reading-") for point in points],
            xscale="log" if study == "rss_2d" else "linear",
            xlabel=f"{component} RMSE{unit}, {study}",
        )
        axes.invert_yaxis()
        axes.legend(fontsize=7, ncols=3, loc="upper center", bbox_to_anchor=(0.4, 1.13))
    return drawn
