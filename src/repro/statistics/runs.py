"""The result of a filter on the trials of a point."""

from typing import NamedTuple

import numpy as np


class Runs(NamedTuple):
    """What a filter's jobs keep of one (study, point), all trials in order."""

    error: np.ndarray  # (trials, steps, n)
    claimed: np.ndarray | None  # claimed error variances, ([trials,] steps, n)
    degenerate: np.ndarray  # guarded updates, (trials,)
    recorded: dict[str, np.ndarray]  # what the closed loop decided
    flown: dict[str, np.ndarray] | None = None  # topics of a closed loop's log; not in the file
