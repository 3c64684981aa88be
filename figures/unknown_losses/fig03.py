"""Figure 3: position RMSE of the radar over time, one panel a loss probability."""

from matplotlib.figure import Figure

from repro.papers.unknown_losses.drawings import error_over_time
from repro.tables.results import Results

NEEDS = {
    "tables": ["radar"],
    "points": {"radar": ["loss=0.1", "loss=0.3", "loss=0.5", "loss=0.7"]},
}
CAPTION = (
    "Figure 3. Median position error of a run over time, with the band of 10 to 90 percent, and "
    "thin the RMSE, which a few lost runs carry; above each panel how many are lost. The "
    "paper's horizon is not known. figures/studies/radar has every filter."
)


def draw(results: Results) -> Figure:
    return error_over_time(results, NEEDS["points"]["radar"])
