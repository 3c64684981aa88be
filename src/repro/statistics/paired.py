"""Differences between filters, on the same trials or on others."""

import numpy as np


def independent_error(one: float, other: float) -> float:
    """Standard error of the difference of two independent numbers with these."""
    return float(np.sqrt(one * one + other * other))


def decided(difference: float, mcse: float, tolerance: float) -> str:
    """Whether a difference of errors is `better`, `worse`, or `not decided` beyond its error."""
    if difference == 0.0 or not abs(difference) > tolerance * mcse:
        return "not decided"
    return "better" if difference < 0 else "worse"
