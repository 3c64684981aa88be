"""Comparisons of RMSE, a statistic of all trials together, on paired trials."""

from collections.abc import Callable
from typing import Any

from repro.statistics import metrics
from repro.statistics.shards import Columns
from repro.verdicts.claims import Part


def negative(
    name: str, combination: Callable[..., Any], *squared: Columns, average: bool = False
) -> Part:
    """A combination of several filters' RMSE is negative; its error is that of paired trials.

    `combination` gets as many numbers, or arrays (trials,), as there are `squared`. Each RMSE is
    the sum over the steps of RMSE_k, or their mean (`average`).
    """
    numbers = [metrics.roots_over_steps(of_filter, average) for of_filter in squared]
    left_out = combination(*(number.left_out for number in numbers))
    value = combination(*(number.value for number in numbers))
    return Part(name, float(value), float(metrics.jackknife_error(left_out)))


def smaller_rmse(name: str, first: Columns, second: Columns, average: bool = False) -> Part:
    """The first filter's RMSE, summed or averaged over the steps, is the smaller."""
    return negative(name, lambda a, b: a - b, first, second, average=average)
