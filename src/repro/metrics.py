"""Statistics over trials, each with the Monte Carlo standard error of that very statistic."""

from typing import NamedTuple

import numpy as np


class Statistic(NamedTuple):
    """A statistic over trials; the quantiles are those of the single trials. Shapes (...)."""

    value: np.ndarray
    mcse: np.ndarray  # Monte Carlo standard error of value
    median: np.ndarray
    q10: np.ndarray
    q90: np.ndarray


def _quantiles(per_trial: np.ndarray) -> list[np.ndarray]:
    return list(np.quantile(per_trial, [0.5, 0.1, 0.9], axis=0))


def mean(per_trial: np.ndarray) -> Statistic:
    """Mean over the trials (axis 0)."""
    return Statistic(per_trial.mean(axis=0), mean_error(per_trial), *_quantiles(per_trial))


def exact(value: float) -> Statistic:
    """A number that is the same in every trial."""
    return Statistic(value, 0.0, value, value, value)


def mean_error(per_trial: np.ndarray) -> np.ndarray:
    """Standard error of a mean over independent trials (axis 0); NaN for one trial."""
    if len(per_trial) < 2:
        return np.full(per_trial.shape[1:], np.nan)
    return per_trial.std(axis=0, ddof=1) / np.sqrt(len(per_trial))


def root_mean(per_trial: np.ndarray) -> Statistic:
    """Root of the mean over the trials of squared errors, with its jackknife standard error."""
    left_out = leave_one_out(per_trial, np.sqrt)
    value = np.sqrt(per_trial.mean(axis=0))
    return Statistic(value, jackknife_error(left_out), *_quantiles(np.sqrt(per_trial)))


def of_mean(per_trial: np.ndarray, function) -> Statistic:
    """function(mean over the trials) with its jackknife standard error.

    function keeps the leading axis and may reduce others: the root over runs, then a mean over k.
    """
    if len(per_trial) > 1:
        mcse = jackknife_error(function(_rest(per_trial)))
    else:
        mcse = np.full_like(function(per_trial)[0], np.nan)
    value = function(per_trial.mean(axis=0, keepdims=True))[0]
    return Statistic(value, mcse, *_quantiles(function(per_trial)))


def root_mean_over_steps(squared: np.ndarray, over_steps) -> Statistic:
    """Sum or mean (`over_steps`) of RMSE_k over the steps; squared errors are (trials, steps).

    RMSE_k is the root of the mean over the trials; the quantiles are those of single trials.
    """
    left_out = over_steps(leave_one_out(squared, np.sqrt), axis=1)
    value = over_steps(np.sqrt(squared.mean(axis=0)))
    single = over_steps(np.sqrt(squared), axis=1)
    return Statistic(value, jackknife_error(left_out), *_quantiles(single))


def leave_one_out(per_trial: np.ndarray, function) -> np.ndarray:
    """function(mean over all trials but one), one row for each trial left out."""
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
