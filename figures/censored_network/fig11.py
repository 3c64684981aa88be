"""Figure 11: true and estimated track of target 3, saturation censoring."""

from matplotlib.figure import Figure

from repro.papers.censored_network.drawings import tracks
from repro.tables.results import Results

NEEDS = {"points": {"saturation": ["base"]}}
CAPTION = (
    "Redrawing of Fig. 11: true and estimated track of target 3, saturation censoring, first run. "
    "The sensors are the fitted layout, not the paper's; dead reckoning, which the paper does not "
    "have, uses no measurement. Every filter: figures/studies/saturation."
)


def draw(results: Results) -> Figure:
    return tracks(results, "saturation", target=3)
