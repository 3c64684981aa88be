"""Figure 4: estimation error of EKF and EMVF, p = 1."""

from repro.papers.packet_delays.tracks import error_over_k

NEEDS = {"tables": ["wsn_tracking"], "points": {"wsn_tracking": ["n1-arrival=1", "n2-arrival=1"]}}
CAPTION = (
    "Figure 4: estimation error of EKF and EMVF, p = 1. The first run in which every packet "
    "is on time."
)


def draw(results):
    trial = 0
    return error_over_k(
        results, "1", trial, ekf=True, published={"Fig. 4: below 0.3 m": (0.3, 0.3)}
    )
