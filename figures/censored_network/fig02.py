"""Figure 2: true and estimated track of target 1, dead-band censoring."""

from repro.papers.censored_network.drawings import track

NEEDS = {"points": {"deadband": ["base"]}}
CAPTION = (
    "Figure 2. True and estimated track of target 1, dead-band censoring, first run. The "
    "sensors are the fitted layout, not the paper's; dead reckoning, which the paper lacks, "
    "sees no measurement."
)


def draw(results):
    return track(results, "deadband", target=1, trial=0)
