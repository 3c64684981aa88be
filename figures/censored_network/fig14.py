"""Figure 14: position RMSE of target 2 over k, saturation censoring."""

from matplotlib.figure import Figure

from repro.papers.censored_network.drawings import rmse_over_k
from repro.tables.results import Results

NEEDS = {
    "tables": ["saturation"],
    "points": {"saturation": ["base"]},
    "diff": True,
}
CAPTION = (
    "Redrawing of Fig. 14: position RMSE of target 2 over k, saturation censoring, with bands of "
    "two standard errors; marks at the right are the averages over k, published and ours. "
    "Sensors, speed, turn rate and horizon were fitted to those averages: agreement of the levels "
    "is a fit, not a prediction. The prior is centred on the truth, so dead reckoning, which the "
    "paper does not have, starts ahead. Every filter: figures/studies/saturation."
)


def draw(results: Results) -> Figure:
    return rmse_over_k(results, "saturation", target=2)
