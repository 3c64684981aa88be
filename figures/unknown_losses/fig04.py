"""Figure 4: position RMSE of the radar at p = 0.1, 0.5 and 0.8."""

from matplotlib.figure import Figure

from repro.papers.unknown_losses.drawings import error_over_time
from repro.tables.results import Results

NEEDS = {"tables": ["radar"], "points": {"radar": ["loss=0.1", "loss=0.5", "loss=0.8"]}}
CAPTION = (
    "Figure 4. As Fig. 3 at p = 0.1, 0.5 and 0.8: median error of a run with the band of 10 to 90 "
    "percent, and thin the RMSE. figures/studies/radar has every filter."
)


def draw(results: Results) -> Figure:
    return error_over_time(results, NEEDS["points"]["radar"])
