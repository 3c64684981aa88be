"""Figure 9: trajectories over time."""

from matplotlib.figure import Figure

from repro.papers.unknown_losses.flights import over_time
from repro.tables.results import Results

NEEDS = {"points": {"quadrotor": ["nominal"]}}
CAPTION = (
    "Figure 9. The flight of Figure 8 in X, Y and Z, on the right less the flight on the IEKF, and "
    "the distance to the path in all flights. "
    "The controller alone is 0.2 m behind: its velocity command is the position error. "
    "figures/studies/quadrotor has every filter."
)


def draw(results: Results) -> Figure:
    (point,) = NEEDS["points"]["quadrotor"]
    return over_time(results, point)
