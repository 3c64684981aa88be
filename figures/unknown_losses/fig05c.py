"""Figure 5c: true and estimated track from a poor start, p = 0.9."""

from repro.papers.unknown_losses.drawings import tracks

NEEDS = {"points": {"radar": ["poor-loss=0.9"]}}
CAPTION = (
    "Figure 5c. As Figs. 5a and 5b, at p = 0.9 and with the filters started on [200, 0, 0] "
    "along each axis."
)


def draw(results):
    return tracks(results, "poor-loss=0.9")
