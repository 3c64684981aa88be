"""Figure 1: sum of RMSE over the loss probability, linear system."""

from repro.papers.unknown_losses.drawings import error_over_p

NEEDS = {"tables": ["linear_losses"]}
CAPTION = (
    "Figure 1. Sum over 200 steps of the RMSE over the loss probability; on the right "
    "relative to the IKF. The RBPF has the paper's 20 particles: too few near p = 0 and 1. "
    "The paper prints no number."
)


def draw(results):
    return error_over_p(results)
