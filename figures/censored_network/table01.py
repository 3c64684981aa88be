"""Table I: time-averaged position RMSE, dead-band censoring, published and reproduced."""

from matplotlib.figure import Figure

from repro.papers.censored_network.drawings import time_averages
from repro.tables.results import Results

NEEDS = {"points": {"deadband": ["base"]}, "diff": True}
CAPTION = (
    "Redrawing of Table I: time-averaged position RMSE, dead-band censoring, published and "
    "ours, with bars of two standard errors (the paper's from our spread at its number of "
    "runs), and dead reckoning, which the paper does not have. The geometry was fitted to these "
    "numbers: agreement of the levels shows only that such a geometry exists. Every filter: "
    "figures/studies/deadband."
)


def draw(results: Results) -> Figure:
    return time_averages(results, "deadband")
