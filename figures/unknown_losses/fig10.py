"""Figure 10: tracking error of the EKF that ignores the losses."""

from matplotlib.figure import Figure

from repro.papers.unknown_losses.flights import ignoring_losses
from repro.tables.results import Results

NEEDS = {"points": {"quadrotor": ["nominal", "far"]}}
CAPTION = (
    "Figure 10. Tracking error of the EKF that ignores the losses. On the path of [26] it is a "
    "bounded bias: the estimate averages y and the loop holds it at the command. On a path 100 "
    "times as large, with filters that trust y, the altitude's estimate drops at every loss and "
    "climbs after it: the derivative shuts the throttle four steps in five, and the quadrotor "
    "falls and tumbles. figures/studies/quadrotor has every filter."
)

TITLES = {
    "nominal": "path of [26]",
    "far": "path 100 times as large, filters that trust y",
}


def draw(results: Results) -> Figure:
    return ignoring_losses(results, TITLES)
