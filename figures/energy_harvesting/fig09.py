"""Figure 9: RMSE of PF-ROSS-EH by the number of sensors."""

from matplotlib.figure import Figure

from repro.papers.energy_harvesting.compared import SENSORS
from repro.papers.energy_harvesting.drawings import sweep_figure
from repro.tables.results import Results

NEEDS = {"tables": ["rss_2d"], "points": {"rss_2d": ["sensors=2", "base", "sensors=6"]}}
CAPTION = (
    "Figure 9. RMSE of PF-ROSS-EH over k by the number of sensors; "
    "in grey the prediction without data. figures/studies/rss_2d has every filter."
)


def draw(results: Results) -> Figure:
    return sweep_figure(results, SENSORS)
