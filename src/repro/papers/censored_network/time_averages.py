"""Time-averaged position RMSE, as in Tables I and II of censored_network.

Shared by the claims, the drawings and the sensitivity table.
"""

from typing import NamedTuple

import numpy as np

from repro.statistics import metrics
from repro.studies.families.censored_network import TARGETS, squared_distance
from repro.tables.results import Results

CENSORING = {"deadband": "dead band", "saturation": "saturation"}  # study -> in words
POINT = "base"  # the parameters of the tables and figures


class TimeAverage(NamedTuple):
    """RMSE in m, averaged over the steps, of each target and of their mean."""

    value: np.ndarray  # (targets + 1,)
    left_out: np.ndarray  # with one trial left out, (trials, targets + 1)

    def mcse(self) -> np.ndarray:
        """Jackknife standard errors, (targets + 1,)."""
        return metrics.jackknife_error(self.left_out)


def time_average(results: Results, study: str, filter_: str) -> TimeAverage:
    """Mean over k = 1 ... K of RMSE_k [censored_network (26)], from the runs of all shards."""
    of_targets = [
        metrics.roots_over_steps(
            results.each(study, POINT, filter_, lambda runs, i=i: squared_distance(runs)[:, 1:, i])
        )
        for i in range(len(TARGETS))
    ]
    numbers = [*of_targets, metrics.average(of_targets)]
    return TimeAverage(
        np.array([number.value for number in numbers]),
        np.stack([number.left_out for number in numbers], axis=1),
    )


def with_average(of_targets: np.ndarray) -> np.ndarray:
    """The targets and their mean, (..., targets) to (..., targets + 1)."""
    return np.concatenate([of_targets, of_targets.mean(axis=-1, keepdims=True)], axis=-1)


def mean_of_roots(squared: np.ndarray) -> np.ndarray:
    """Mean over the steps of the roots, (..., steps, targets) to (..., targets + 1)."""
    return with_average(np.sqrt(squared).mean(axis=-2))


def root_of_mean(squared: np.ndarray) -> np.ndarray:
    """Root of the mean over the steps, the other reading of a time-averaged RMSE."""
    return with_average(np.sqrt(squared.mean(axis=-2)))
