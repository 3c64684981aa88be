"""Figure 9: trajectory of the EMVF, p = 0.90."""

from matplotlib.figure import Figure

from repro.papers.packet_delays.tracks import run_of_figure_10, trajectories
from repro.tables.results import Results

NEEDS = {"points": {"wsn_tracking": ["n1-arrival=0.9", "n2-arrival=0.9"]}}
CAPTION = (
    "Figure 9. Trajectory of the EMVF, p = 0.90. The first run in which as many packets are late "
    "or lost as in the paper."
)


def draw(results: Results) -> Figure:
    trial = run_of_figure_10(results, "0.9")
    return trajectories(results, "0.9", trial, ekf=False)
