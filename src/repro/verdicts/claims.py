"""The papers' claims, tested on paired trials: one module a paper, one function a claim.

Every part of a claim is put as "this difference is negative" and decided by its standard error.
"""

from collections.abc import Callable, Iterable
from importlib import import_module
from pathlib import Path
from typing import NamedTuple

import numpy as np

from repro.statistics import metrics
from repro.tables.csv_file import write_csv
from repro.tables.results import Results


class Part(NamedTuple):
    """One comparison: the claim says that `difference` is negative."""

    name: str
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


Test = Callable[[Results], Iterable[Part]]


class Claim(NamedTuple):
    """A claim of a paper, and the comparisons that decide it."""

    item: str
    statement: str
    test: Test


def claim(registry: list[Claim], item: str, statement: str) -> Callable[[Test], Test]:
    """Decorator that adds a test to a paper's list of claims."""

    def register(test: Test) -> Test:
        registry.append(Claim(item, statement, test))
        return test

    return register


def smaller(name: str, first: np.ndarray, second: np.ndarray) -> Part:
    """The mean of `first` is smaller than that of `second`, paired over trials, (trials,) each."""
    difference = first - second
    return Part(name, float(difference.mean()), float(metrics.mean_error(difference)))


def most(name: str, happens: np.ndarray) -> Part:
    """More than half of the runs have it, (runs,); `difference` is one half minus their share."""
    share = happens.mean() if len(happens) else np.nan
    error = np.sqrt(share * (1 - share) / max(len(happens), 1))
    return Part(f"{name} (share {share:.3f} of {len(happens)})", float(0.5 - share), float(error))


def below(name: str, value: float, bound: float) -> Part:
    """A number without Monte Carlo error is below a bound."""
    return Part(f"{name} ({value:.3g} against {bound:.3g})", float(value - bound), 0.0)


def overall(verdicts: Iterable[str]) -> str:
    """A claim fails if a part fails, and holds if every part holds."""
    distinct = set(verdicts)
    if "fails" in distinct:
        return "fails"
    return "holds" if distinct == {"holds"} else "undecided"


def decide(results: Results, paper: str, path: str | Path) -> None:
    """Test every claim of a paper; write one row for each part."""
    rows = []
    claims: list[Claim] = import_module(f"repro.papers.{paper}.claims").CLAIMS
    for item, statement, test in claims:
        for part in test(results):
            rows.append(
                {"paper": paper, "item": item, "statement": statement, "part": part.name}
                | {"difference": part.difference, "mcse": part.mcse}
                | {"verdict": part.verdict(results.tolerance)}
            )
    write_csv(rows, path)
