"""Figure 1: error of x1 over the packet arrival probability."""

from repro.papers.packet_delays.error_over_arrival import error_over_arrival_probability

NEEDS = {"tables": ["linear_delays"]}
CAPTION = (
    "Figure 1. RMS error of x1 over the packet arrival probability, all filters, with the "
    "error that the OMVF claims. The paper prints no number; [21] and the best filter of form"
    " (6) are exact."
)


def draw(results):
    return error_over_arrival_probability(results, "x1")
