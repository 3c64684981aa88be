"""Time-averaged position RMSE, as in Tables I and II of censored_network.

Shared by the claims, the facts, the drawings and the sensitivity table.
"""

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np

from repro.statistics import metrics
from repro.statistics.metrics import Jackknife
from repro.statistics.shards import Columns
from repro.studies.families.censored_network import TARGETS, squared_distance
from repro.tables.results import Results

CENSORING = {"deadband": "dead band", "saturation": "saturation"}  # study -> in words
POINT = "base"  # the parameters of the tables and figures
PUBLISHED = "params/published/censored_network.csv"
FROM_1 = slice(1, None)  # k = 1 ... K


class TimeAverage(NamedTuple):
    """RMSE in m, averaged over the steps, of each target and of their mean."""

    value: np.ndarray  # (targets + 1,)
    left_out: np.ndarray  # with one trial left out, (trials, targets + 1)

    def mcse(self) -> np.ndarray:
        """Jackknife standard errors, (targets + 1,)."""
        return metrics.jackknife_error(self.left_out)


def root_over_steps(squared: Columns) -> Jackknife:
    """Root of the mean over the steps, the other reading of a time-averaged RMSE."""
    return metrics.root(squared.mean_over_steps())


def first_trials(
    trials: int, average: Callable[[Columns], Jackknife] = metrics.roots_over_steps
) -> Callable[[Columns], Jackknife]:
    """The average of the first of the trials, to be paired with a point that has no more."""
    return lambda squared: average(squared.only(np.arange(squared.trials) < trials))


def time_average(
    results: Results,
    study: str,
    filter_: str,
    point: str = POINT,
    steps: slice = FROM_1,
    average: Callable[[Columns], Jackknife] = metrics.roots_over_steps,
) -> TimeAverage:
    """Mean over k = 1 ... K of RMSE_k [censored_network (26)], from the runs of all shards."""
    of_targets = [
        average(
            results.each(
                study, point, filter_, lambda runs, i=i: squared_distance(runs)[:, steps, i]
            )
        )
        for i in range(len(TARGETS))
    ]
    numbers = [*of_targets, metrics.average(of_targets)]
    return TimeAverage(
        np.array([number.value for number in numbers]),
        np.stack([number.left_out for number in numbers], axis=1),
    )


Average = Callable[..., TimeAverage]  # of (results, study, filter)


OTHER_AVERAGES: dict[str, Average] = {  # what else a time average could be
    "from k = 0": partial(time_average, steps=slice(None)),
    "root of the mean over k": partial(time_average, average=root_over_steps),
}
