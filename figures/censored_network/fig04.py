"""Figure 4: true and estimated track of target 3, dead-band censoring."""

from matplotlib.figure import Figure

from repro.papers.censored_network.drawings import track
from repro.tables.results import Results

NEEDS = {"points": {"deadband": ["base"]}}
CAPTION = (
    "Figure 4. True and estimated track of target 3, dead-band censoring, first run. The "
    "sensors are the fitted layout, not the paper's; dead reckoning, which the paper does not "
    "have, uses no measurement."
)


def draw(results: Results) -> Figure:
    return track(results, "deadband", target=3, trial=0)
