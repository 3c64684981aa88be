"""Figure 5: what the filter of target 1 receives first, dead-band censoring."""

from matplotlib.figure import Figure

from repro.papers.censored_network.drawings import first_component
from repro.tables.results import Results

NEEDS = {"points": {"deadband": ["base"]}}
CAPTION = (
    "Redrawing of Fig. 5: first component of what the filter of target 1 receives, dead-band "
    "censoring, median run: which group of sensors transmits, and the censored value. The filter "
    "is not told the group."
)


def draw(results: Results) -> Figure:
    return first_component(results, "deadband")
