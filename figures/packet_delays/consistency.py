"""Whether the filters' own covariances are true."""

from matplotlib.figure import Figure

from repro.plot import consistency
from repro.tables.results import Results

NEEDS = {"consistency": ["linear_delays", "wsn_tracking"]}
CAPTION = (
    "Are the filters' own covariances true? Left: NEES, the squared error measured by the claimed "
    "covariance and divided by the number of components, mean over runs and steps; 1 if true, "
    "larger if the filter is overconfident. Grey: bounds of a true covariance at so many runs. "
    "Right: share of the errors inside the 50 % and 95 % regions (dotted: if true). Not in the "
    "paper."
)


def draw(results: Results) -> Figure:
    return consistency.draw(results, NEEDS["consistency"])
