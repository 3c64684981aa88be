"""Figure 9: RMSE of PF-ROSS-EH by the number of sensors."""

from repro.papers.energy_harvesting.drawings import sweep_figure

NEEDS = {"tables": ["rss_2d"], "points": {"rss_2d": ["base"]}}
CAPTION = (
    "Figure 9. RMSE of PF-ROSS-EH over k by the number of sensors; "
    "in grey the prediction without data."
)


def draw(results):
    return sweep_figure(results, {"sensors=2": "N = 2", "base": "N = 4", "sensors=6": "N = 6"})
