"""Figure 4: true and estimated track of target 3, dead-band censoring."""

from matplotlib.figure import Figure

from repro.papers.censored_network.drawings import tracks
from repro.tables.results import Results

NEEDS = {"points": {"deadband": ["base"]}}
CAPTION = (
    "Redrawing of Fig. 4: true and estimated track of target 3, dead-band censoring, median run. "
    "The other targets of the run are beside it. The sensors are the fitted layout, not the "
    "paper's; dead reckoning, which the paper does not have, uses no measurement. Every filter: "
    "figures/studies/deadband."
)


def draw(results: Results) -> Figure:
    return tracks(results, "deadband", target=3)
