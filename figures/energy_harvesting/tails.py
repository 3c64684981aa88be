"""Errors of all runs of the tracking studies, and where the shown run lies among them."""

from matplotlib.figure import Figure

from repro.papers.energy_harvesting.compared import PAPERS_FILTERS
from repro.papers.energy_harvesting.shown import shown_run
from repro.plot.tails import Panel, tails
from repro.tables.results import Results

NEEDS = {"points": {"rss_2d": ["base"], "rss_3d": ["base"]}}
CAPTION = (
    "Share of the runs with a larger error than that on the axis, of every filter. Crosses: the "
    "run that the redrawings of single runs show; a quantile is the share of the runs that are "
    "better. Where a line ends far to the right, a few lost runs make up the RMSE."
)


def draw(results: Results) -> Figure:
    return tails(
        results,
        [
            Panel(study, "base", {"the shown run": shown_run(results, study).trial}, PAPERS_FILTERS)
            for study in NEEDS["points"]
        ],
    )
