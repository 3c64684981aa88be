"""Comparisons of RMSE, a statistic of all trials together, on paired trials."""

import numpy as np

from repro import metrics
from repro.claims import Part


def rmse(over_steps, *squared: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Sum or mean over the steps of RMSE_k, of each filter and with one trial left out each."""
    values = [over_steps(np.sqrt(s.mean(axis=0))) for s in squared]
    left_out = [over_steps(metrics.leave_one_out(s, np.sqrt), axis=1) for s in squared]
    return np.array(values), np.array(left_out)


def negative(what: str, combination, over_steps, *squared: np.ndarray) -> Part:
    """A combination of several filters' RMSE is negative; its error is that of paired trials."""
    values, left_out = rmse(over_steps, *squared)
    error = metrics.jackknife_error(combination(*left_out))
    return Part(what, float(combination(*values)), float(error))


def smaller_rmse(what: str, first: np.ndarray, second: np.ndarray, over_steps=np.sum) -> Part:
    """The first filter's RMSE, summed or averaged over the steps, is the smaller."""
    return negative(what, lambda a, b: a - b, over_steps, first, second)
