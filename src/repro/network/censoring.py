"""Censored measurements (Song et al., (4) and (5)): what arrives of an ideal reading, and a code.

The code is how a receiver knows a censored value: a constant may equal no reading by accident, but
comparing floating-point numbers is not how to find out.
"""

from typing import NamedTuple

import numpy as np

EXACT, BELOW, ABOVE, INSIDE = 0, 1, 2, 3


class Censoring(NamedTuple):
    """Thresholds of all sensors, in the unit of the readings; lower <= upper."""

    kind: str  # "dead band" or "saturation"
    lower: float  # y_l
    upper: float  # y_r
    constant: float  # y_const, what a dead band gives


def censored(ideal: np.ndarray, censoring: Censoring) -> tuple[np.ndarray, np.ndarray]:
    """Received values and their codes, shapes as `ideal`.

    A boundary belongs to the passing case of (4) and to the censored case of (5).
    """
    lower, upper = censoring.lower, censoring.upper
    if censoring.kind == "dead band":  # (4); its third case is read as the ideal value
        inside = (lower < ideal) & (ideal < upper)
        return np.where(inside, censoring.constant, ideal), np.where(inside, INSIDE, EXACT)
    codes = np.select([ideal <= lower, ideal >= upper], [BELOW, ABOVE], EXACT)  # (5)
    return np.clip(ideal, lower, upper), codes
