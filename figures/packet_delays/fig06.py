"""Figure 6: estimation error of EKF and EMVF, p = 0.98."""

from matplotlib.figure import Figure

from repro.papers.packet_delays.tracks import error_over_k, run_of_figure_6
from repro.tables.results import Results

NEEDS = {
    "tables": ["wsn_tracking"],
    "points": {"wsn_tracking": ["n1-arrival=0.98", "n2-arrival=0.98"]},
}
CAPTION = (
    "Redrawing of Fig. 6: estimation error of EKF and EMVF, p = 0.98, and of the EKF that knows "
    "the arrivals, in the median run in which a single packet is late or lost, that of the step "
    "that the paper names. Every filter: figures/studies/wsn_tracking."
)


def draw(results: Results) -> Figure:
    run = run_of_figure_6(results, "0.98")
    return error_over_k(results, "0.98", run, ekf=True)
