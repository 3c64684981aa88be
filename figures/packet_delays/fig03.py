"""Figure 3: trajectory of EKF and EMVF, p = 1."""

from matplotlib.figure import Figure

from repro.papers.packet_delays.tracks import run_missing, trajectories
from repro.tables.results import Results

NEEDS = {"points": {"wsn_tracking": ["n1-arrival=1", "n2-arrival=1"]}}
CAPTION = (
    "Redrawing of Fig. 3: trajectory of EKF and EMVF, p = 1, in the median run in which every "
    "packet is on time, and of the EKF that knows the arrivals. Every filter: "
    "figures/studies/wsn_tracking."
)


def draw(results: Results) -> Figure:
    run = run_missing(results, "1", 0, ekf=True)
    return trajectories(results, "1", run, ekf=True)
