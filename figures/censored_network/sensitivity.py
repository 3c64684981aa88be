"""Which published order survives which unstated assumption. Drawn on request: it takes minutes."""

from repro.papers.censored_network.drawings import sensitivity

NEEDS = {"tables": ["deadband_sensitivity", "saturation_sensitivity"], "on_request": True}
CAPTION = (
    "Time-averaged position RMSE, averaged over the targets, with one assumption changed at a "
    "time (60 runs each, the base 300), bars of two standard errors; and the verdict on each "
    "published order on the same runs: full mark holds, cross fails, ring undecided."
)


def draw(results):
    return sensitivity(results)
