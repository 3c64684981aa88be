"""Statistics over trials, each with the Monte Carlo standard error of that very statistic.

What is summed over trials is summed over an axis that holds all of them and nothing else, so that
no statistic depends on the number of shards.
"""

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

import numpy as np

from repro.statistics.shards import Columns


class Statistic(NamedTuple):
    """A statistic over trials; the quantiles are those of the single trials.

    Each entry is a number, or an array (steps,) for a statistic of every step.
    """

    value: Any
    mcse: Any  # Monte Carlo standard error of value
    median: Any
    q10: Any
    q90: Any


class Jackknife(NamedTuple):
    """A number of all trials, the same with one trial left out each, and of each trial alone."""

    value: float
    left_out: np.ndarray  # (trials,)
    single: np.ndarray  # (trials,)


def _per_step(
    quantity: np.ndarray | Columns, of_steps: Callable[[np.ndarray], Statistic]
) -> Statistic:
    """of_steps, a function of (steps, trials), on every step, or on the one number of a trial."""
    if isinstance(quantity, Columns):
        of_blocks = [of_steps(block) for block in quantity.blocks()]
        return Statistic(*(np.concatenate(parts) for parts in zip(*of_blocks, strict=True)))
    return Statistic(*(values[0] for values in of_steps(quantity[None])))


def _quantiles(single: np.ndarray) -> list[np.ndarray]:
    # To sort first takes a third of the time: of what is sorted NumPy partitions little.
    ascending = np.sort(single, axis=-1)
    return list(np.quantile(ascending, [0.5, 0.1, 0.9], axis=-1, overwrite_input=True))


def mean(quantity: np.ndarray | Columns) -> Statistic:
    """Mean over the trials of one number a trial, (trials,), or of one a trial and step."""
    return _per_step(
        quantity,
        lambda x: Statistic(x.mean(axis=-1), mean_error(x.T), *_quantiles(x)),
    )


def exact(value: float) -> Statistic:
    """A number that is the same in every trial."""
    return Statistic(value, 0.0, value, value, value)


def mean_error(per_trial: np.ndarray) -> np.ndarray:
    """Standard error of a mean over independent trials (axis 0); NaN for one trial."""
    if len(per_trial) < 2:
        return np.full(per_trial.shape[1:], np.nan)
    return per_trial.std(axis=0, ddof=1) / np.sqrt(len(per_trial))


def root_mean(squared: np.ndarray | Columns) -> Statistic:
    """Root of the mean over the trials of squared errors, with its jackknife standard error."""

    def of_steps(x: np.ndarray) -> Statistic:
        value, left_out = np.sqrt(x.mean(axis=-1)), leave_one_out(x.T, np.sqrt)
        return Statistic(value, jackknife_error(left_out), *_quantiles(np.sqrt(x)))

    return _per_step(squared, of_steps)


def roots_over_steps(squared: Columns, average: bool = True) -> Jackknife:
    """Mean, or sum, over the steps of RMSE_k, the root of the mean over the trials."""
    value, left_out, single = 0.0, np.zeros(squared.trials), np.zeros(squared.trials)
    for block in squared.blocks():
        rest = leave_one_out(block.T, np.sqrt).T
        # Step by step, as the sums must not depend on how many steps a block has.
        for root, left, of_each in zip(np.sqrt(block.mean(axis=1)), rest, block, strict=True):
            value += float(root)
            left_out += left
            single += np.sqrt(of_each)
    return _scaled(Jackknife(value, left_out, single), 1 / squared.steps if average else 1.0)


def root(squared: np.ndarray) -> Jackknife:
    """Root of the mean over the trials of one number a trial, (trials,)."""
    value, left_out = np.sqrt(squared.mean()), leave_one_out(squared, np.sqrt)
    return Jackknife(float(value), left_out, np.sqrt(squared))


def average(numbers: Sequence[Jackknife]) -> Jackknife:
    """Mean of several numbers of the same trials."""
    first, *others = numbers
    value, left_out, single = first
    for number in others:
        value = value + number.value
        left_out = left_out + number.left_out
        single = single + number.single
    return _scaled(Jackknife(value, left_out, single), 1 / len(numbers))


def _scaled(number: Jackknife, factor: float) -> Jackknife:
    return Jackknife(factor * number.value, factor * number.left_out, factor * number.single)


def statistic(number: Jackknife) -> Statistic:
    """A jackknifed number with its standard error and the quantiles of the single trials."""
    return Statistic(number.value, jackknife_error(number.left_out), *_quantiles(number.single))


def leave_one_out(
    per_trial: np.ndarray, function: Callable[[np.ndarray], np.ndarray]
) -> np.ndarray:
    """function(mean over all trials but one), a row for each trial left out; NaN for one trial."""
    if len(per_trial) < 2:
        return np.full(per_trial.shape, np.nan)
    return function(_rest(per_trial))


def _rest(per_trial: np.ndarray) -> np.ndarray:
    """Mean over all trials but one, of quantities that are not negative."""
    return np.maximum((per_trial.sum(axis=0) - per_trial) / (len(per_trial) - 1), 0.0)


def jackknife_error(left_out: np.ndarray) -> np.ndarray:
    """Jackknife standard error from the statistics with one trial left out each (axis 0)."""
    trials = len(left_out)
    return np.sqrt((trials - 1) / trials * ((left_out - left_out.mean(axis=0)) ** 2).sum(axis=0))
