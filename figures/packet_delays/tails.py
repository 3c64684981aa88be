"""Errors of all runs in the field, and where the shown runs lie among them."""

from matplotlib.figure import Figure

from repro.papers.packet_delays.points import FIGURES_3_6, FIGURES_7_10, TRACKING, tracking_point
from repro.papers.packet_delays.tracks import run_of_figure_6, run_of_figure_8, run_of_figure_10
from repro.plot.tails import Panel, tails
from repro.tables.results import Results

NEEDS = {
    "points": {
        "wsn_tracking": ["n1-arrival=0.98", "n1-arrival=0.95", "n1-arrival=0.9", "n2-arrival=0.9"]
    }
}
CAPTION = (
    "Share of the runs with a larger error than that on the axis, of every filter. Crosses: the "
    "runs that the redrawings of Figs. 5 to 10 show; a quantile is the share of the runs that are "
    "better. Where a line ends far to the right, a few runs make up the mean."
)


def draw(results: Results) -> Figure:
    figure_10 = {"Figs. 9, 10": run_of_figure_10(results, "0.9").trial}
    shown = [
        (1, "0.98", {"Figs. 5, 6": run_of_figure_6(results, "0.98").trial}, FIGURES_3_6),
        (1, "0.95", {"Figs. 7, 8": run_of_figure_8(results, "0.95").trial}, FIGURES_7_10),
        (1, "0.9", figure_10, FIGURES_7_10),
        (2, "0.9", figure_10, FIGURES_7_10),
    ]
    return tails(
        results,
        [Panel(TRACKING, tracking_point(n, p), runs, filters) for n, p, runs, filters in shown],
    )
