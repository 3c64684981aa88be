"""Figure 7: velocity RMSE in the plane."""

from matplotlib.figure import Figure

from repro.papers.energy_harvesting.drawings import rmse_figure
from repro.tables.results import Results

NEEDS = {"tables": ["rss_2d"], "points": {"rss_2d": ["base"]}}
CAPTION = (
    "Figure 7. RMSE of the velocity in the plane; in grey the prediction from x(0) without any "
    "data. The paper prints no number. figures/studies/rss_2d has every filter."
)


def draw(results: Results) -> Figure:
    return rmse_figure(results, "rss_2d", "velocity")
