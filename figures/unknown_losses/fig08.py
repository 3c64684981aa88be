"""Figure 8: trajectories of the controlled quadrotor in space."""

from matplotlib.figure import Figure

from repro.papers.unknown_losses.flights import in_space
from repro.tables.results import Results

NEEDS = {"points": {"quadrotor": ["nominal"]}}
CAPTION = (
    "Figure 8. One flight on the estimates of each filter, the one whose rms distance to the path "
    "is the median with the RBPF; on the right how far each is from the flight on the IEKF. Every "
    "filter flies under the same noise and losses, p = 0.2. figures/studies/quadrotor has every "
    "filter."
)


def draw(results: Results) -> Figure:
    (point,) = NEEDS["points"]["quadrotor"]
    return in_space(results, point)
