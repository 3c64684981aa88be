"""Figure 9: true and estimated track of target 1, saturation censoring."""

from repro.papers.censored_network.drawings import track

NEEDS = {"points": {"saturation": ["base"]}}
CAPTION = (
    "Figure 9. True and estimated track of target 1, saturation censoring, first run. The "
    "sensors are the fitted layout, not the paper's; dead reckoning, which the paper lacks, "
    "sees no measurement."
)


def draw(results):
    return track(results, "saturation", target=1, trial=0)
