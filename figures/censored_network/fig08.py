"""Figure 8: position RMSE of target 3 over k, dead-band censoring."""

from matplotlib.figure import Figure

from repro.papers.censored_network.drawings import rmse_over_k
from repro.tables.results import Results

NEEDS = {
    "tables": ["deadband"],
    "points": {"deadband": ["base"]},
    "diff": True,
}
CAPTION = (
    "Figure 8. Position RMSE of target 3 over k, dead-band censoring, with bands of two "
    "standard errors; bars at the right are the published averages over k. Sensors, speed, "
    "turn rate and horizon were fitted to those averages: agreement of the levels is a fit, not "
    "a prediction. The prior is centred on the truth, so dead reckoning starts ahead."
)


def draw(results: Results) -> Figure:
    return rmse_over_k(results, "deadband", target=3)
