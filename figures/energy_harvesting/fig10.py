"""Figure 10: RMSE of PF-ROSS-EH by the harvest."""

from matplotlib.figure import Figure

from repro.papers.energy_harvesting.compared import HARVESTS
from repro.papers.energy_harvesting.drawings import sweep_figure
from repro.tables.results import Results

NEEDS = {"tables": ["rss_2d"], "points": {"rss_2d": ["base"]}}
CAPTION = (
    "Figure 10. RMSE of PF-ROSS-EH over k by the harvest; in grey the prediction without data. "
    "figures/studies/rss_2d has every filter."
)


def draw(results: Results) -> Figure:
    return sweep_figure(results, HARVESTS)
