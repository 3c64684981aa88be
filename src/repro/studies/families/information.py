"""What the measurements of a study say about its state, on which a lower bound of errors rests."""

from typing import NamedTuple

import numpy as np

from repro.models import Model
from repro.models.sparse import dense


class Information(NamedTuple):
    """A linear motion with Gaussian noise, and the Fisher information of what arrives."""

    transition: np.ndarray  # F, (n, n)
    noise: np.ndarray  # Q, (n, n)
    start: np.ndarray  # covariance of x(0), (n, n)
    first: int  # step of the first measurement
    informations: np.ndarray  # mean over the truths, (steps, sensors, n, n)
    arrived: np.ndarray  # flags, (trials, steps, sensors)


def mean_information(rows: np.ndarray, precisions: np.ndarray) -> np.ndarray:
    """Mean over the trials of H' R^-1 H, (n, n), from rows (trials, m, n) and 1 / R (m,)."""
    return np.einsum("tmi,m,tmj->ij", rows, precisions, rows) / len(rows)


def of_model(model: Model, truth: np.ndarray, arrived: np.ndarray, first: int) -> Information:
    """Of a model with a linear motion and independent noises, truth (trials, steps, n).

    arrived (trials, steps): whether a measurement is one, or noise alone.
    """
    motion = model.transition_jacobian(truth[:, 0], 0)
    assert isinstance(motion, np.ndarray) and motion.ndim == 2
    trials, steps, n = truth.shape
    precisions = 1.0 / np.diagonal(model.measurement_covariance)
    informations = np.empty((steps, 1, n, n))
    for k in range(steps):
        jacobian = model.measurement_jacobian(np.ascontiguousarray(truth[:, k]), None)
        informations[k, 0] = mean_information(dense(jacobian, (trials,), n), precisions)
    return Information(
        motion.astype(float),
        model.process_covariance.astype(float),
        model.initial_covariance.astype(float),
        first,
        informations,
        arrived[:, :, None] > 0.5,
    )
