"""Random access protocol (Song et al., (6)-(7)): one group of sensors transmits a step."""

import numpy as np


def transmitting_group(uniform: np.ndarray, probabilities: np.ndarray) -> np.ndarray:
    """rho in 0 ... M - 1 from a uniform, iid with the given probabilities."""
    edges = np.cumsum(probabilities)[:-1]
    return np.searchsorted(edges, uniform, side="right")


def transmitted(readings: np.ndarray, group: np.ndarray) -> np.ndarray:
    """(7): readings of the group on the network; (..., M, b) and (...) give (..., b)."""
    return np.take_along_axis(readings, group[..., None, None], axis=-2)[..., 0, :]
