"""Figure 10: RMSE of PF-ROSS-EH by the harvest."""

from repro.papers.energy_harvesting.drawings import sweep_figure

NEEDS = {"tables": ["rss_2d"], "points": {"rss_2d": ["base"]}}
CAPTION = (
    "Figure 10. RMSE of PF-ROSS-EH over k by the harvest; in grey the prediction without data."
)


def draw(results):
    return sweep_figure(results, {"base": r"$\Pi_1$", "harvest=pi_2": r"$\Pi_2$"})
