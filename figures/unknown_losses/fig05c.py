"""Figure 5c: true and estimated track from a poor start, p = 0.9."""

from matplotlib.figure import Figure

from repro.papers.unknown_losses.drawings import tracks
from repro.tables.results import Results

NEEDS = {"points": {"radar": ["poor-loss=0.9"]}}
CAPTION = (
    "Figure 5c. As Figs. 5a and 5b, at p = 0.9 and with the filters started on [200, 0, 0] "
    "along each axis. figures/studies/radar has every filter."
)


def draw(results: Results) -> Figure:
    (point,) = NEEDS["points"]["radar"]
    return tracks(results, point, "p = 0.9, poor start")
