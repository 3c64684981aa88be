"""Figure 8: estimation error of the EMVF, p = 0.95."""

from matplotlib.figure import Figure

from repro.papers.packet_delays.tracks import error_over_k, run_of_figure_8
from repro.tables.results import Results

NEEDS = {
    "tables": ["wsn_tracking"],
    "points": {"wsn_tracking": ["n1-arrival=0.95", "n2-arrival=0.95"]},
}
CAPTION = (
    "Redrawing of Fig. 8: estimation error of the EMVF, p = 0.95, and of the EKF that knows the "
    "arrivals, in the median run in which as many packets are late or lost as on average. Every "
    "filter: figures/studies/wsn_tracking."
)


def draw(results: Results) -> Figure:
    run = run_of_figure_8(results, "0.95")
    return error_over_k(results, "0.95", run, ekf=False)
