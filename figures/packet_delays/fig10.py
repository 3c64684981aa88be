"""Figure 10: estimation error of the EMVF, p = 0.90."""

from matplotlib.figure import Figure

from repro.papers.packet_delays.tracks import error_over_k, printed_largest_errors, run_of_figure_10
from repro.tables.results import Results

NEEDS = {
    "tables": ["wsn_tracking"],
    "points": {"wsn_tracking": ["n1-arrival=0.9", "n2-arrival=0.9"]},
}
CAPTION = (
    "Redrawing of Fig. 10: estimation error of the EMVF, p = 0.90, and of the EKF that knows "
    "the arrivals, in the median run in which as many packets are late or lost as in the paper. "
    "Every filter: figures/studies/wsn_tracking."
)


def draw(results: Results) -> Figure:
    run = run_of_figure_10(results, "0.9")
    return error_over_k(results, "0.9", run, ekf=False, published=printed_largest_errors(results))
