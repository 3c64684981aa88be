"""Whether filters' own covariances are true: what the runs keep of it, and its statistics."""

from typing import NamedTuple

import numpy as np

from repro.statistics.shards import Columns

INNOVATION = "normalised innovation"  # e' S^-1 e / m of the runs; NaN where there is none


def normalised(group: str) -> str:
    """Name in the runs of e' P^-1 e / d of a group of d components."""
    return f"nees {group}"


def claimed(group: str) -> str:
    """Name in the runs of the trace of the covariance that a filter claims of a group."""
    return f"claimed {group}"


class Ratio(NamedTuple):
    """A ratio of two means over trials, of all steps together or of each."""

    value: np.ndarray | float
    mcse: np.ndarray | float  # its Monte Carlo standard error, to first order


def ratio_of(numerators: np.ndarray, denominators: np.ndarray) -> Ratio:
    """Ratio of the means over the last axis, that of the trials."""
    trials = numerators.shape[-1]
    with np.errstate(divide="ignore", invalid="ignore"):
        value = numerators.sum(axis=-1) / denominators.sum(axis=-1)
        deviation = numerators - value[..., None] * denominators
        spread = np.sqrt((deviation**2).sum(axis=-1) / (trials - 1) / trials)
        mcse = spread / (denominators.sum(axis=-1) / trials)
    return Ratio(value, mcse)


def over_all(numerator: Columns, denominator: Columns) -> Ratio:
    """Ratio of the means over trials and steps."""
    return ratio_of(numerator.mean_over_steps(), denominator.mean_over_steps())


def over_k(numerator: Columns, denominator: Columns) -> Ratio:
    """Ratio of the means over the trials, of every step."""
    pairs = zip(numerator.blocks(), denominator.blocks(), strict=True)
    of_blocks = [ratio_of(above, below) for above, below in pairs]
    return Ratio(*(np.concatenate(parts) for parts in zip(*of_blocks, strict=True)))
