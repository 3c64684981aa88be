"""Which single run a figure shows: one rule for all figures."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np


class TypicalRun(NamedTuple):
    """A run, and where it stands."""

    trial: int
    ranks: tuple[int, ...]  # from 1, by each error
    among: int  # runs that qualify

    @property
    def words(self) -> str:
        """For a title: which run, and its rank among those that qualify."""
        low, high = min(self.ranks), max(self.ranks)
        rank = f"rank {low}" if low == high else f"ranks {low} to {high}"
        return f"run {self.trial}, {rank} of {self.among} by error"


def typical_run(errors: Sequence[np.ndarray], qualifies: np.ndarray | None = None) -> TypicalRun:
    """The median run of those that qualify (of all if none does).

    `errors` has one (trials,) a curve that is compared. With several, the run whose rank is nowhere
    far from the middle: its largest distance to it is the smallest; the first of equals.
    """
    every = np.arange(len(errors[0]))
    chosen = every if qualifies is None or not qualifies.any() else every[qualifies]
    ranks = np.stack([_ranks(np.asarray(error)[chosen]) for error in errors])
    place = np.abs(ranks - len(chosen) // 2).max(axis=0).argmin()
    return TypicalRun(
        int(chosen[place]), tuple(int(rank) + 1 for rank in ranks[:, place]), len(chosen)
    )


def _ranks(error: np.ndarray) -> np.ndarray:
    """Place of each entry in rising order from 0; equal ones in their own order."""
    ranks = np.empty(len(error), dtype=int)
    ranks[np.argsort(error, kind="stable")] = np.arange(len(error))
    return ranks
