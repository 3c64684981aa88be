"""Figure 13: velocity RMSE in space."""

from matplotlib.figure import Figure

from repro.papers.energy_harvesting.drawings import rmse_figure
from repro.tables.results import Results

NEEDS = {"tables": ["rss_3d"], "points": {"rss_3d": ["base"]}}
CAPTION = (
    "Figure 13. RMSE of the velocity in space; in grey the prediction from x(0) without any "
    "data. The paper prints no number. figures/studies/rss_3d has every filter."
)


def draw(results: Results) -> Figure:
    return rmse_figure(results, "rss_3d", "velocity")
