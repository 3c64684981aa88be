"""A path through way-points in space, linear between them in time; the last is held."""

import numpy as np


def reference(times: list[float], waypoints: list[list[float]], at: np.ndarray) -> np.ndarray:
    """Rows of way-points (times, components) interpolated at the times `at` in s."""
    columns = np.array(waypoints, dtype=float).T
    return np.stack([np.interp(at, times, column) for column in columns], axis=-1)
