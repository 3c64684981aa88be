"""Censored measurements [censored_network (4), (5)]: what arrives of an ideal reading, and a code.

The code tells a receiver which values are censored, so that no floating-point numbers need to be
compared for equality.
"""

from typing import NamedTuple

import numpy as np

EXACT, BELOW, ABOVE, INSIDE = 0, 1, 2, 3


class Censoring(NamedTuple):
    """Thresholds of all sensors, in the unit of the readings; lower <= upper."""

    kind: str  # "dead band" or "saturation"
    lower: float  # y_l
    upper: float  # y_r
    constant: float  # y_const, which replaces a reading inside a dead band


def censored(ideal: np.ndarray, censoring: Censoring) -> tuple[np.ndarray, np.ndarray]:
    """Received values and their codes, each of the shape of `ideal`.

    A reading on a threshold passes a dead band (4) and is censored by saturation (5).
    """
    lower, upper = censoring.lower, censoring.upper
    if censoring.kind == "dead band":  # (4); its third case is read as: the ideal value passes
        inside = (lower < ideal) & (ideal < upper)
        return np.where(inside, censoring.constant, ideal), np.where(inside, INSIDE, EXACT)
    codes = np.select([ideal <= lower, ideal >= upper], [BELOW, ABOVE], EXACT)  # (5)
    return np.clip(ideal, lower, upper), codes
