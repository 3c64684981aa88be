"""Figure 1: error of x1 over the packet arrival probability."""

from matplotlib.figure import Figure

from repro.papers.packet_delays.error_over_arrival import error_over_arrival_probability
from repro.tables.results import Results

NEEDS = {"tables": ["linear_delays"]}
CAPTION = (
    "Figure 1. RMS error of x1 over the packet arrival probability, all filters, with the error "
    "that the OMVF claims. The paper prints no number. The filter of Sun (2009) and the best "
    "filter of the OMVF's form (6) are exact."
)


def draw(results: Results) -> Figure:
    return error_over_arrival_probability(results, "x1")
