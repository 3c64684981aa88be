"""What the choices that the paper leaves open change: RMSE of the filters under each reading."""

from matplotlib.figure import Figure

from repro.papers.energy_harvesting.compared import EXTENSIONS, PAPERS_FILTERS
from repro.plot import style
from repro.plot.readings import ROW, draw_readings, readings_of_point
from repro.tables.results import Results

NEEDS = {"tables": ["rss_2d", "ungm"]}
CAPTION = (
    "RMSE (mean over k) under one changed assumption at a time, with bars of two standard errors: "
    "position in the plane above, the scalar example below. Crosses are median runs. "
    "figures/studies/rss_2d and figures/studies/ungm have every filter."
)
PANELS = (
    ("rss_2d", "position", "in the plane", "position RMSE in m", True),
    ("ungm", "state", "scalar example", "RMSE", False),
)


def draw(results: Results) -> Figure:
    rows = [len(readings_of_point(results, study, "base")) for study, *_ in PANELS]
    drawn, grid = style.figure(
        2,
        1,
        size=(style.WIDTH, 1.3 * ROW * sum(rows) + 2.0),
        gridspec_kw={"height_ratios": rows},
    )
    named = (*PAPERS_FILTERS, *EXTENSIONS)
    for axes, (study, component, title, label, log) in zip(grid, PANELS, strict=True):
        draw_readings(axes, results, study, "base", "rmse", component, named, title, log)
        axes.set_xlabel(label)
    legend = {
        label: handle
        for axes in grid
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True)
    }
    drawn.legend(legend.values(), legend.keys(), fontsize=8, ncols=4, loc="outside lower center")
    return drawn
