"""Figure 5b: true and estimated track, p = 0.7."""

from matplotlib.figure import Figure

from repro.papers.unknown_losses.drawings import tracks
from repro.tables.results import Results

NEEDS = {"points": {"radar": ["loss=0.7"]}}
CAPTION = (
    "Figure 5b. One run at p = 0.7, the one in which the RBPF's last error is the median of "
    "all runs; the paper does not say how it chose its own. figures/studies/radar has every "
    "filter."
)


def draw(results: Results) -> Figure:
    (point,) = NEEDS["points"]["radar"]
    return tracks(results, point, "p = 0.7")
