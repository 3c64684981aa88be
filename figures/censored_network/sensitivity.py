"""Which published order survives which unstated assumption; on request, as it takes a minute."""

from matplotlib.figure import Figure

from repro.papers.censored_network.drawings import sensitivity
from repro.tables.results import Results

NEEDS = {"tables": ["deadband_sensitivity", "saturation_sensitivity"], "on_request": True}
CAPTION = (
    "Time-averaged position RMSE, averaged over the targets, with one assumption changed at a "
    "time and bars of two standard errors (the base has more runs than the others); and the "
    "verdict on each published order on the same runs: full mark holds, cross fails, ring "
    "undecided."
)


def draw(results: Results) -> Figure:
    return sensitivity(results)
