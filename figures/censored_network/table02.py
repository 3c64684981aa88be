"""Table II: time-averaged position RMSE, saturation censoring, published and reproduced."""

from repro.papers.censored_network.drawings import time_averages

NEEDS = {"points": {"saturation": ["base"]}, "diff": True}
CAPTION = (
    "Table II. Time-averaged position RMSE, saturation censoring, published and ours, bars of "
    "two standard errors (theirs from our spread at their 300 runs), and dead reckoning, "
    "which the paper lacks. The geometry was fitted to these numbers: agreement of levels "
    "says that such a geometry exists."
)


def draw(results):
    return time_averages(results, "saturation")
