"""Figure 9: true and estimated track of target 1, saturation censoring."""

from matplotlib.figure import Figure

from repro.papers.censored_network.drawings import track
from repro.tables.results import Results

NEEDS = {"points": {"saturation": ["base"]}}
CAPTION = (
    "Figure 9. True and estimated track of target 1, saturation censoring, first run. The "
    "sensors are the fitted layout, not the paper's; dead reckoning, which the paper does not "
    "have, uses no measurement."
)


def draw(results: Results) -> Figure:
    return track(results, "saturation", target=1, trial=0)
