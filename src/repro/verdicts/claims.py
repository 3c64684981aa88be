"""The papers' claims, tested on paired trials: one module a paper, one function a claim.

Every part of a claim is put as "this difference is negative" and decided by its standard error.
"""

from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import NamedTuple

import numpy as np

from repro.statistics import metrics
from repro.tables.csv_file import write_csv
from repro.tables.results import Results


class Part(NamedTuple):
    """One comparison: the claim says that `difference` is negative."""

    what: str
    difference: float
    mcse: float

    def verdict(self, tolerance: float) -> str:
        """holds or fails beyond `tolerance` standard errors, undecided within."""
        margin = tolerance * self.mcse
        if not np.isfinite(self.difference) or np.isnan(self.mcse):
            return "undecided"
        if self.difference < -margin:
            return "holds"
        return "fails" if self.difference > margin or self.mcse == 0 else "undecided"


class Claim(NamedTuple):
    item: str
    statement: str
    test: Callable[[Results], list[Part]]


def claim(registry: list[Claim], item: str, statement: str):
    """Decorator: put a test under the item's name into a paper's list of claims."""

    def register(test):
        registry.append(Claim(item, statement, test))
        return test

    return register


def smaller(what: str, first: np.ndarray, second: np.ndarray) -> Part:
    """The mean of `first` is smaller than that of `second`, paired over trials."""
    difference = first - second
    return Part(what, float(difference.mean()), float(metrics.mean_error(difference)))


def most(what: str, happens: np.ndarray) -> Part:
    """More than half of the runs have it; `difference` is one half minus their share."""
    share = happens.mean() if len(happens) else np.nan
    error = np.sqrt(share * (1 - share) / max(len(happens), 1))
    return Part(f"{what} (share {share:.3f} of {len(happens)})", float(0.5 - share), float(error))


def below(what: str, value: float, bound: float) -> Part:
    """A number without Monte Carlo error is below a bound."""
    return Part(f"{what} ({value:.3g} against {bound:.3g})", float(value - bound), 0.0)


def overall(verdicts: list[str]) -> str:
    """A claim fails if a part fails, and holds if every part holds."""
    if "fails" in verdicts:
        return "fails"
    return "holds" if set(verdicts) == {"holds"} else "undecided"


def decide(results: Results, paper: str, path: str | Path) -> None:
    """Test every claim of a paper; write one row a part."""
    rows = []
    for item, statement, test in import_module(f"repro.papers.{paper}.claims").CLAIMS:
        for part in test(results):
            rows.append(
                {"paper": paper, "item": item, "statement": statement, "part": part.what}
                | {"difference": part.difference, "mcse": part.mcse}
                | {"verdict": part.verdict(results.tolerance)}
            )
    write_csv(rows, path)
