"""The Kalman filters of `linear_losses` and `radar` in FilterPy, one object a trial.

For benchmarks/kalman_filters.py. Every received value is taken for a measurement, as EKF does.
"""

from collections.abc import Callable
from math import atan2, hypot, pi
from typing import Any

import numpy as np
from filterpy.kalman import ExtendedKalmanFilter, KalmanFilter

from repro import plugins
from repro.logs import Log


def filtered(log: Log, trials: int) -> Callable[[], np.ndarray]:
    """A function that filters the first trials and returns their estimates, (trials, steps, n)."""
    study = plugins.study(log.study)
    model, first = study.model(log.parameters), study.first_step(log.parameters)
    update = {"linear_losses": _update, "radar": _update_by_radar}[log.study]

    def run() -> np.ndarray:
        estimates = np.empty((trials, log.steps - first, len(model.initial_mean)))
        for trial, received in enumerate(log.values["/received"][:trials]):
            filter_ = started(log, model)
            for k in range(first, log.steps):
                if k > 0:
                    filter_.predict()
                update(filter_, received[k])
                estimates[trial, k - first] = filter_.x[:, 0]
        return estimates

    return run


def started(log: Log, model: Any) -> Any:
    """The library's filter before the first measurement."""
    n, m = len(model.initial_mean), len(model.measurement_covariance)
    kind = KalmanFilter if log.study == "linear_losses" else ExtendedKalmanFilter
    filter_: Any = kind(dim_x=n, dim_z=m)
    filter_.x, filter_.P = model.initial_mean[:, None].copy(), model.initial_covariance.copy()
    filter_.F = model.transition_jacobian(model.initial_mean, 0)
    filter_.Q, filter_.R = model.process_covariance, model.measurement_covariance
    if kind is KalmanFilter:
        filter_.H = np.array([log.parameters.measurement_row])
    return filter_


def _update(filter_: Any, received: np.ndarray) -> None:
    filter_.update(received[:, None])


def _update_by_radar(filter_: Any, received: np.ndarray) -> None:
    filter_.update(received[:, None], _jacobian, _measurement, residual=_wrapped)


def _measurement(x: np.ndarray) -> np.ndarray:
    return np.array([[hypot(x[0, 0], x[3, 0])], [atan2(x[3, 0], x[0, 0])]])


def _jacobian(x: np.ndarray) -> np.ndarray:
    p1, p2 = x[0, 0], x[3, 0]
    distance = hypot(p1, p2)
    c, s = p1 / distance, p2 / distance
    return np.array([[c, 0, 0, s, 0, 0], [-s / distance, 0, 0, c / distance, 0, 0]])


def _wrapped(received: np.ndarray, expected: np.ndarray) -> np.ndarray:
    difference = received - expected
    difference[1] = (difference[1] + pi) % (2 * pi) - pi
    return difference
