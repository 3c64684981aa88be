"""Figure 13: velocity RMSE in space."""

from repro.papers.energy_harvesting.drawings import rmse_figure

NEEDS = {"tables": ["rss_3d"], "points": {"rss_3d": ["base"]}}
CAPTION = (
    "Figure 13. RMSE of the velocity in space, all filters; in grey the prediction "
    "from x(0) without any data. The paper prints no number."
)


def draw(results):
    return rmse_figure(results, "rss_3d", "velocity")
