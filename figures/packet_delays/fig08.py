"""Figure 8: estimation error of the EMVF, p = 0.95."""

from repro.papers.packet_delays.tracks import error_over_k, first_trial, missed_steps

NEEDS = {
    "tables": ["wsn_tracking"],
    "points": {"wsn_tracking": ["n1-arrival=0.95", "n2-arrival=0.95"]},
}
CAPTION = (
    "Figure 8: estimation error of the EMVF, p = 0.95. The first run in which three packets "
    "are late or lost, the mean number."
)


def draw(results):
    missed = missed_steps(results, "0.95")
    trial = first_trial(missed[:, 1:].sum(axis=1) == 3)
    return error_over_k(results, "0.95", trial, ekf=False, published={})
