"""Errors over the number of particles."""

from matplotlib.figure import Figure

from repro.plot.convergence import convergence
from repro.tables.results import Results

NEEDS = {"convergence": ["ungm", "rss_2d", "rss_3d"]}
CAPTION = (
    "Above: the error over the number of particles; dotted, the paper's number. Below: the rms "
    "distance of the estimates from those with the most particles, and the fitted rate of its "
    "square from the paper's number on, which is 1 for Monte Carlo errors. Bands and bars: two "
    "standard errors."
)


def draw(results: Results) -> Figure:
    return convergence(results, NEEDS["convergence"])
