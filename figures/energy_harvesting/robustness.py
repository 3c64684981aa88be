"""Every verdict of the paper under every reading of what the paper leaves open."""

from matplotlib.figure import Figure

from repro.plot.robustness import robustness
from repro.tables.results import Results

NEEDS = {"diff": True}
CAPTION = (
    "Verdicts of the energy-harvesting paper under other readings of what it leaves open, the"
    " most fragile first. Blank: the reading has not the points that the verdict needs."
)


def draw(results: Results) -> Figure:
    return robustness(results, "energy_harvesting")
