"""Figure 8: RMSE of PF-ROSS-EH by the probability of saturation."""

from matplotlib.figure import Figure

from repro.papers.energy_harvesting.compared import SATURATIONS
from repro.papers.energy_harvesting.drawings import sweep_figure
from repro.tables.results import Results

NEEDS = {"tables": ["rss_2d"], "points": {"rss_2d": ["base", "gamma=0.5", "gamma=0.8"]}}
CAPTION = (
    "Figure 8. RMSE of PF-ROSS-EH over k by the probability of saturation; "
    "in grey the prediction without data. figures/studies/rss_2d has every filter."
)


def draw(results: Results) -> Figure:
    return sweep_figure(results, SATURATIONS)
