"""Figure 4: position RMSE of the radar at p = 0.1, 0.5 and 0.8."""

from repro.papers.unknown_losses.drawings import error_over_time_together

NEEDS = {"tables": ["radar"]}
CAPTION = (
    "Figure 4. Position RMSE over time at p = 0.1, 0.5 and 0.8, with bands of 2 standard errors."
)


def draw(results):
    return error_over_time_together(results, (0.1, 0.5, 0.8))
