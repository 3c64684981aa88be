"""Figure 9: trajectory of the EMVF, p = 0.90."""

from repro.papers.packet_delays.tracks import first_trial, missed_steps, trajectories

NEEDS = {"points": {"wsn_tracking": ["n1-arrival=0.9", "n2-arrival=0.9"]}}
CAPTION = (
    "Figure 9: trajectory of the EMVF, p = 0.90. The first run in which seven packets are "
    "late or lost, as in the paper."
)


def draw(results):
    missed = missed_steps(results, "0.9")
    trial = first_trial(missed[:, 1:].sum(axis=1) == 7)
    return trajectories(results, "0.9", trial, ekf=False)
