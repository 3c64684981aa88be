"""Figure 4: estimation error of EKF and EMVF, p = 1."""

from matplotlib.figure import Figure

from repro.papers.packet_delays.tracks import error_over_k, printed_small_error, run_missing
from repro.tables.results import Results

NEEDS = {"tables": ["wsn_tracking"], "points": {"wsn_tracking": ["n1-arrival=1", "n2-arrival=1"]}}
CAPTION = (
    "Redrawing of Fig. 4: estimation error of EKF and EMVF, p = 1, in the median run in which "
    "every packet is on time, and of the EKF that knows the arrivals. Every filter: "
    "figures/studies/wsn_tracking."
)


def draw(results: Results) -> Figure:
    run = run_missing(results, "1", 0, ekf=True)
    return error_over_k(results, "1", run, ekf=True, published=printed_small_error(results))
