"""Table I: time-averaged position RMSE, dead-band censoring, published and reproduced."""

from repro.papers.censored_network.drawings import time_averages

NEEDS = {"points": {"deadband": ["base"]}, "diff": True}
CAPTION = (
    "Table I. Time-averaged position RMSE, dead-band censoring, published and ours, bars of "
    "two standard errors (theirs from our spread at their 300 runs), and dead reckoning, "
    "which the paper lacks. The geometry was fitted to these numbers: agreement of levels "
    "says that such a geometry exists."
)


def draw(results):
    return time_averages(results, "deadband")
