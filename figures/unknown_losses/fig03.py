"""Figure 3: position RMSE of the radar over time, one panel a loss probability."""

from repro.papers.unknown_losses.drawings import error_over_time

NEEDS = {"tables": ["radar"]}
CAPTION = (
    "Figure 3. Position RMSE over time with bands of 2 standard errors, and the medians of "
    "the runs: a few lost runs carry the RMSE. The paper's horizon is not known."
)


def draw(results):
    return error_over_time(results, (0.1, 0.3, 0.5, 0.7))
