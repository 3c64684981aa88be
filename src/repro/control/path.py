"""A path through way-points in space, linear between them in time; the last is held."""

import numpy as np
from numpy.typing import ArrayLike


def reference(times: ArrayLike, waypoints: ArrayLike, at: np.ndarray) -> np.ndarray:
    """Rows of way-points (times, components) interpolated at the times `at` in s."""
    columns = np.array(waypoints, dtype=float).T
    known = np.asarray(times, dtype=float)
    return np.stack([np.interp(at, known, column) for column in columns], axis=-1)
