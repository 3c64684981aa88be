"""Would as many runs as the paper's have decided its claims? From the margins, without runs."""

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import Any

import numpy as np
import pandas as pd

from repro.tables.csv_file import write_csv
from repro.verdicts.claims import overall

COLUMNS = [
    *("paper", "item", "statement", "verdict", "runs", "printed_runs", "margin"),
    *("margin_as_printed", "verdict_as_printed", "runs_needed"),
]


def write_decidable(
    claims: Iterable[str], printed: Mapping[str, int | None], tolerance: float, path: str
) -> None:
    """Write a row for each claim that rests on runs, given the files of the papers' claims.

    `printed` are the runs of each study in its paper.
    """
    rows = [row for file in claims for row in _rows(pd.read_csv(file), printed, tolerance)]
    write_csv(pd.DataFrame(rows, columns=COLUMNS), path)


def _rows(
    claims: pd.DataFrame, printed: Mapping[str, int | None], tolerance: float
) -> Iterator[dict[str, Any]]:
    """A margin is a difference over its standard error, which falls with the root of the runs."""
    for item, parts in claims.groupby("item", sort=False):
        ours = runs_of_studies(parts["runs"].iloc[0])
        margins = parts["margin"].to_numpy(dtype=float)
        known = {study: runs for study in ours if (runs := printed.get(study))}
        if not ours or known.keys() != ours.keys() or not np.isfinite(margins).all():
            continue
        study = min(ours, key=lambda name: known[name] / ours[name])
        share = known[study] / ours[study]
        as_printed = margins * math.sqrt(share)
        least = float(margins[np.abs(margins).argmin()])
        failing = margins > tolerance
        deciding = float(margins.max()) if failing.any() else least
        yield {
            "paper": parts["paper"].iloc[0],
            "item": item,
            "statement": parts["statement"].iloc[0],
            "verdict": overall(parts["verdict"]),
            "runs": ours[study],
            "printed_runs": known[study],
            "margin": deciding,
            "margin_as_printed": deciding * math.sqrt(share),
            "verdict_as_printed": overall(_verdict(margin, tolerance) for margin in as_printed),
            "runs_needed": math.ceil(ours[study] * (tolerance / deciding) ** 2)
            if deciding
            else np.nan,
        }


def _verdict(margin: float, tolerance: float) -> str:
    if margin < -tolerance:
        return "holds"
    return "fails" if margin > tolerance else "undecided"


def runs_of_studies(text: object) -> dict[str, int]:
    """Runs of each study, from the column `runs` of the claims."""
    entries = str(text).split() if isinstance(text, str) else []
    return {study: int(runs) for study, _, runs in (entry.partition(":") for entry in entries)}
