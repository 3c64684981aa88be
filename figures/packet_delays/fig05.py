"""Figure 5: trajectory of EKF and EMVF, p = 0.98."""

from repro.papers.packet_delays.tracks import first_trial, missed_steps, trajectories

NEEDS = {"points": {"wsn_tracking": ["n1-arrival=0.98", "n2-arrival=0.98"]}}
CAPTION = (
    "Figure 5: trajectory of EKF and EMVF, p = 0.98. The first run in which the packet of k ="
    " 46 alone is late or lost, as in the paper."
)


def draw(results):
    missed = missed_steps(results, "0.98")
    trial = first_trial((missed.sum(axis=1) == 1) & missed[:, 46])
    return trajectories(results, "0.98", trial, ekf=True)
