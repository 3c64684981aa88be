"""Random access protocol [censored_network (6), (7)]: one group of sensors transmits per step."""

import numpy as np


def transmitting_group(uniform: np.ndarray, probabilities: np.ndarray) -> np.ndarray:
    """rho in 0 ... M - 1, of the shape of `uniform`; `probabilities` (M,) of the groups.

    [censored_network (6)]: independent from step to step.
    """
    edges = np.cumsum(probabilities)[:-1]
    return np.searchsorted(edges, uniform, side="right")


def transmitted(readings: np.ndarray, group: np.ndarray) -> np.ndarray:
    """Readings (..., b) of the transmitting group, from (..., M, b) [censored_network (7)]."""
    return np.take_along_axis(readings, group[..., None, None], axis=-2)[..., 0, :]
