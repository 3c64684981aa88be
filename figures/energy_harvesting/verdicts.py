"""Every published value and claim of the paper with its verdict."""

from matplotlib.figure import Figure

from repro.plot.verdicts import verdicts
from repro.tables.results import Results

NEEDS = {"diff": True}
CAPTION = (
    "Verdicts of the energy-harvesting paper, by class of evidence. Every comparison behind "
    "each claim, in standard errors. The paper prints no value to compare."
)


def draw(results: Results) -> Figure:
    return verdicts(results, "energy_harvesting")
