"""Figure 9: trajectory of the EMVF, p = 0.90."""

from matplotlib.figure import Figure

from repro.papers.packet_delays.tracks import run_of_figure_10, trajectories
from repro.tables.results import Results

NEEDS = {"points": {"wsn_tracking": ["n1-arrival=0.9", "n2-arrival=0.9"]}}
CAPTION = (
    "Redrawing of Fig. 9: trajectory of the EMVF, p = 0.90, and of the EKF that knows the "
    "arrivals, in the median run in which as many packets are late or lost as in the paper. "
    "Every filter: figures/studies/wsn_tracking."
)


def draw(results: Results) -> Figure:
    run = run_of_figure_10(results, "0.9")
    return trajectories(results, "0.9", run, ekf=False)
