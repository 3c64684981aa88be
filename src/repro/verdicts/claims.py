"""The papers' claims, tested on paired trials: one module a paper, one function a claim.

Every part of a claim is put as "this difference is negative" and decided by its standard error.
"""

import math
from collections.abc import Callable, Collection, Iterable, Mapping
from importlib import import_module
from pathlib import Path
from typing import NamedTuple

import numpy as np

from repro.statistics import metrics
from repro.tables.csv_file import write_csv
from repro.tables.results import Results
from repro.tables.under_reading import UnderReading

# Of two root seeds' numbers, the error of their difference over that of each.
OF_TWO_SEEDS = math.sqrt(2.0)
RISKS = ("not_holds", "not_fails", "only_holds", "only_fails")  # columns of the claims


class Part(NamedTuple):
    """One comparison: the claim says that `difference` is negative."""

    name: str
    difference: float
    mcse: float
    seed_error: float | None = None  # of a difference from a bound that allows for the mcse already

    def possible(self, tolerance: float) -> set[str]:
        """Verdicts that other root seeds may give.

        The difference moves by `tolerance` times the error of a difference of two seeds' numbers.
        """
        error = self.mcse if self.seed_error is None else self.seed_error
        moved = tolerance * OF_TWO_SEEDS * error
        shifts = (-moved, 0.0, moved) if np.isfinite(moved) else (0.0,)
        at = [self._replace(difference=self.difference + shift) for shift in shifts]
        return {part.verdict(tolerance) for part in at}

    def risks(self, tolerance: float) -> dict[str, float]:
        """Probabilities that with a fresh root seed a verdict is not, or alone, possible.

        By the name of a column of the claims. A fresh difference is ours plus two errors' worth:
        that of ours and its own.
        """
        error = self.mcse if self.seed_error is None else self.seed_error
        moved, margin = tolerance * OF_TWO_SEEDS * error, tolerance * self.mcse
        if not np.isfinite(self.difference + moved + margin):  # undecided with any seed
            return dict(zip(RISKS, (1.0, 1.0, 0.0, 0.0), strict=True))

        def below(limit: float) -> float:
            if error == 0:
                return float(self.difference < limit)
            return 0.5 * math.erfc((self.difference - limit) / (2.0 * error))

        not_holds, not_fails = 1.0 - below(moved - margin), below(margin - moved)
        only_holds, only_fails = below(-margin - moved), 1.0 - below(margin + moved)
        return dict(zip(RISKS, (not_holds, not_fails, only_holds, only_fails), strict=True))

    @property
    def margin(self) -> float:
        """Standard errors by which the difference is above zero; infinite for an exact number."""
        if self.mcse != 0:
            return self.difference / self.mcse
        return math.copysign(math.inf, self.difference) if self.difference else 0.0

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


def most(name: str, happens: np.ndarray, bound: float = 0.5) -> Part:
    """More than this share of the runs have it, (runs,); `difference` is `bound` minus theirs."""
    share = happens.mean() if len(happens) else np.nan
    error = np.sqrt(share * (1 - share) / max(len(happens), 1))
    return Part(f"{name} (share {share:.3f} of {len(happens)})", float(bound - share), float(error))


def below(name: str, value: float, bound: float, seed_error: float = 0.0) -> Part:
    """A number is below a bound that allows for its Monte Carlo error, if it has one."""
    name = f"{name} ({value:.3g} against {bound:.3g})"
    return Part(name, float(value - bound), 0.0, seed_error)


def overall(verdicts: Iterable[str]) -> str:
    """A claim fails if a part fails, and holds if every part holds."""
    distinct = set(verdicts)
    if "fails" in distinct:
        return "fails"
    return "holds" if distinct == {"holds"} else "undecided"


def possible_overall(of_parts: Iterable[Collection[str]]) -> set[str]:
    """Verdicts of a claim whose parts may each have several."""
    sets = [set(possible) for possible in of_parts]
    found = set()
    if any("fails" in possible for possible in sets):
        found.add("fails")
    if all("holds" in possible for possible in sets):
        found.add("holds")
    if all(possible != {"fails"} for possible in sets) and any("undecided" in p for p in sets):
        found.add("undecided")
    return found


def risk(expect: str, of_parts: Mapping[str, np.ndarray]) -> float:
    """Probability that a fresh root seed cannot give the expected verdict; an upper bound.

    `of_parts` are the columns of `Part.risks`, (parts,) each; the parts share their trials, so that
    their probabilities are added where any of them decides, and the smallest is taken else.
    """
    if expect == "holds":
        return min(1.0, float(of_parts["not_holds"].sum()))
    if expect == "fails":
        return float(of_parts["not_fails"].min())
    return min(1.0, float(of_parts["only_fails"].sum() + of_parts["only_holds"].min()))


def decide(results: Results, paper: str, path: str | Path) -> None:
    """Test every claim of a paper; write one row for each part.

    `runs` are the fewest of each study that the claim looks at.
    """
    rows = []
    claims: list[Claim] = import_module(f"repro.papers.{paper}.claims").CLAIMS
    as_they_are = {study: {p: p for p in points} for study, points in results.catalogue.items()}
    view = UnderReading(results, as_they_are)
    for item, statement, test in claims:
        view.used.clear()
        parts = list(test(view))
        runs: dict[str, int] = {}
        for (study, _, _), trials in sorted(view.used.items()):
            runs[study] = min(trials, runs.get(study, trials))
        for part in parts:
            rows.append(
                {"paper": paper, "item": item, "statement": statement, "part": part.name}
                | {"difference": part.difference, "mcse": part.mcse, "margin": part.margin}
                | {"verdict": part.verdict(results.tolerance)}
                | {"possible": " ".join(sorted(part.possible(results.tolerance)))}
                | part.risks(results.tolerance)
                | {"runs": " ".join(f"{study}:{number}" for study, number in runs.items())}
            )
    write_csv(rows, path)
