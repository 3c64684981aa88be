"""The Kalman filters of `linear_losses` and `radar` in NumPy, all trials at once.

For benchmarks/kalman_filters.py: the textbook's equations on stacks of matrices, (trials, n, n).
Every received value is taken for a measurement, as EKF does.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from repro import plugins
from repro.logs import Log


def filtered(log: Log, trials: int) -> Callable[[], np.ndarray]:
    """A function that filters the first trials and returns their estimates, (trials, steps, n)."""
    study = plugins.study(log.study)
    model, first = study.model(log.parameters), study.first_step(log.parameters)
    observe = {"linear_losses": _row(log.parameters), "radar": _radar}[log.study]
    transition, q, r = (
        model.transition_jacobian(model.initial_mean, 0),
        model.process_covariance,
        model.measurement_covariance,
    )
    received, identity = log.values["/received"][:trials], np.eye(len(q))

    def run() -> np.ndarray:
        x = np.tile(model.initial_mean, (trials, 1))
        p = np.tile(model.initial_covariance, (trials, 1, 1))
        estimates = np.empty((trials, log.steps - first, len(identity)))
        for k in range(first, log.steps):
            if k > 0:
                x = x @ transition.T
                p = transition @ p @ transition.T + q
            innovation, h = observe(x, received[:, k])
            cross = p @ h.swapaxes(-2, -1)
            gain = cross @ np.linalg.inv(h @ cross + r)
            x = x + np.matvec(gain, innovation)
            p = (identity - gain @ h) @ p
            estimates[:, k - first] = x
        return estimates

    return run


def _row(parameters: Any) -> Callable:
    h = np.array([getattr(parameters, "measurement_row", ())])
    return lambda x, received: (received - x @ h.T, h)


def _radar(x: np.ndarray, received: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Innovation (trials, 2), its bearing wrapped, and the Jacobian (trials, 2, 6)."""
    p1, p2 = x[:, 0], x[:, 3]
    distance = np.hypot(p1, p2)
    innovation = received - np.stack([distance, np.arctan2(p2, p1)], axis=-1)
    innovation[:, 1] = (innovation[:, 1] + np.pi) % (2 * np.pi) - np.pi
    h = np.zeros((len(x), 2, 6))
    h[:, 0, 0], h[:, 0, 3] = p1 / distance, p2 / distance
    h[:, 1, 0], h[:, 1, 3] = -h[:, 0, 3] / distance, h[:, 0, 0] / distance
    return innovation, h
