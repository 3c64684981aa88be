"""Figure 8: RMSE of PF-ROSS-EH by the probability of saturation."""

from repro.papers.energy_harvesting.drawings import sweep_figure

NEEDS = {"tables": ["rss_2d"], "points": {"rss_2d": ["base"]}}
CAPTION = (
    "Figure 8. RMSE of PF-ROSS-EH over k by the probability of saturation; "
    "in grey the prediction without data."
)


def draw(results):
    return sweep_figure(
        results,
        {
            "base": r"$\bar{\gamma}=0.2$",
            "gamma=0.5": r"$\bar{\gamma}=0.5$",
            "gamma=0.8": r"$\bar{\gamma}=0.8$",
        },
    )
