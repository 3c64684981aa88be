"""Figure 1: sum of RMSE over the loss probability, linear system."""

from matplotlib.figure import Figure

from repro.papers.unknown_losses.drawings import error_over_p
from repro.tables.results import Results

NEEDS = {"tables": ["linear_losses"], "points": {"linear_losses": ["loss=0.05"]}}
CAPTION = (
    "Figure 1. Sum over the steps of the RMSE over the loss probability; on the right relative to "
    "the IKF. The RBPF has as many particles as in the paper: too few near p = 0 and 1. "
    "The paper prints no number; figures/studies/linear_losses has every filter."
)


def draw(results: Results) -> Figure:
    return error_over_p(results)
