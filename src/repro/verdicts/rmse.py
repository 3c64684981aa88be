"""Comparisons of RMSE, a statistic of all trials together, on paired trials."""

from collections.abc import Callable
from typing import Any

from repro.statistics import metrics
from repro.statistics.metrics import Jackknife
from repro.verdicts.claims import Part


def negative(name: str, combination: Callable[..., Any], *numbers: Jackknife) -> Part:
    """A combination of several filters' RMSE is negative; its error is that of paired trials.

    `combination` gets as many numbers, or arrays (trials,), as there are RMSE in `numbers`.
    """
    left_out = combination(*(number.left_out for number in numbers))
    value = combination(*(number.value for number in numbers))
    return Part(name, float(value), float(metrics.jackknife_error(left_out)))


def smaller_rmse(name: str, first: Jackknife, second: Jackknife) -> Part:
    """The first filter's RMSE is the smaller."""
    return negative(name, lambda a, b: a - b, first, second)
