"""Figure 3: trajectory of EKF and EMVF, p = 1."""

from repro.papers.packet_delays.tracks import trajectories

NEEDS = {"points": {"wsn_tracking": ["n1-arrival=1", "n2-arrival=1"]}}
CAPTION = (
    "Figure 3: trajectory of EKF and EMVF, p = 1. The first run in which every packet is on time."
)


def draw(results):
    trial = 0
    return trajectories(results, "1", trial, ekf=True)
