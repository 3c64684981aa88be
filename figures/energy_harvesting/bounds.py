"""How far the filters are from the least possible error."""

from matplotlib.figure import Figure

from repro.plot import bounds
from repro.tables.results import Results

NEEDS = {"bounds": ["rss_2d", "rss_3d"]}
CAPTION = (
    "RMSE of every filter over a lower bound of it. Cramer-Rao, losses known: the posterior bound "
    "of a filter that knows what arrives, averaged over the arrivals. Others: what the best filter "
    "of a kind claims. No filter of the kind is below 1 but by chance; the measurements "
    "of SPF-IM are unimpaired, so that it may be. Not in the paper."
)


def draw(results: Results) -> Figure:
    return bounds.draw(results, NEEDS["bounds"])
