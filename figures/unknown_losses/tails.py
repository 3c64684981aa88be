"""Errors of all runs of the radar, and where the shown runs lie among them."""

from matplotlib.figure import Figure

from repro.papers.unknown_losses.drawings import shown_run
from repro.papers.unknown_losses.points import PICTURED
from repro.plot.tails import Panel, tails
from repro.tables.results import Results

NEEDS = {"points": {"radar": ["loss=0.1", "loss=0.5", "loss=0.7", "poor-loss=0.9"]}}
CAPTION = (
    "Share of the runs with a larger error than that on the axis, of every filter. Crosses: the "
    "runs that the redrawings of Figs. 5a to 5c show; a quantile is the share of the runs that are "
    "better. Where a line ends far to the right, a few lost runs make up the RMSE."
)


def draw(results: Results) -> Figure:
    shown = {"loss=0.5": "Fig. 5a", "loss=0.7": "Fig. 5b", "poor-loss=0.9": "Fig. 5c"}
    return tails(
        results,
        [
            Panel(
                "radar",
                point,
                {shown[point]: shown_run(results, point).trial} if point in shown else {},
                PICTURED["radar"],
            )
            for point in NEEDS["points"]["radar"]
        ],
    )
