"""Figure 12: what the filter of target 1 receives first, saturation censoring."""

from matplotlib.figure import Figure

from repro.papers.censored_network.drawings import first_component
from repro.tables.results import Results

NEEDS = {"points": {"saturation": ["base"]}}
CAPTION = (
    "Redrawing of Fig. 12: first component of what the filter of target 1 receives, saturation "
    "censoring, median run: which group of sensors transmits, and the censored value. The filter "
    "is not told the group."
)


def draw(results: Results) -> Figure:
    return first_component(results, "saturation")
