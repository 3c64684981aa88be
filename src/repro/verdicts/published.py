"""The diff: what the papers print, what came out here, and whether the two agree."""

from pathlib import Path

import numpy as np
import pandas as pd

from repro.errors import ReproError
from repro.verdicts.claims import overall

VERDICTS = {"value": ("match", "differs"), "claim": ("holds", "fails", "undecided")}
REPRODUCED = ("match", "holds")
KEYS = ["study", "point", "filter", "metric", "component"]
COLUMNS = ["item", *KEYS, "value", "digits", "kind", "trials", "expect", "reason"]


def read_published(path: str | Path) -> pd.DataFrame:
    """A paper's published values and claims, checked; raises ReproError in one line."""
    try:
        rows = pd.read_csv(path, keep_default_na=False, dtype=str)
    except (OSError, ValueError) as error:
        raise ReproError(f"{path}: cannot be read: {error}") from None
    if list(rows.columns) != COLUMNS:
        raise ReproError(f"{path}: the columns must be {', '.join(COLUMNS)}")
    for i, row in enumerate(rows.itertuples(), start=2):
        where = f"{path}: line {i} ({row.item})"
        if row.kind not in VERDICTS:
            raise ReproError(f"{where}: kind '{row.kind}' is not one of {', '.join(VERDICTS)}")
        if row.expect not in VERDICTS[row.kind]:
            raise ReproError(
                f"{where}: expect '{row.expect}' is not one of {', '.join(VERDICTS[row.kind])}"
            )
        if row.expect not in REPRODUCED and not row.reason:
            raise ReproError(f"{where}: expect '{row.expect}' needs a reason")
        if row.kind == "value":
            for name in ("value", "digits", "trials"):
                try:
                    float(getattr(row, name))
                except ValueError:
                    raise ReproError(f"{where}: {name} must be a number") from None
    return rows


def compare_value(
    published: float, digits: int, their_trials: int, ours: pd.Series, tolerance: float
) -> dict:
    """One published value against our statistic.

    The paper prints no error of its own: its is taken as our spread over trials at its number of
    trials. Within `tolerance` standard errors of both, plus half the last printed digit: match.
    """
    their_error = ours["mcse"] * np.sqrt(ours["trials"] / their_trials)
    error = np.hypot(ours["mcse"], their_error)
    rounding = 0.5 * 10.0**-digits
    difference = ours["value"] - published
    allowed = tolerance * error + rounding
    return {
        "published": published,
        "ours": ours["value"],
        "mcse": ours["mcse"],
        "their_error": their_error,
        "allowed": allowed,
        "z": difference / error if error > 0 else np.nan,
        "verdict": "match" if abs(difference) <= allowed else "differs",
    }


def compare(paper: str, published: pd.DataFrame, tables, claims, tolerance: float, source: str):
    """Rows of the diff of one paper, in the order of its published file."""
    index = tables.set_index(KEYS).sort_index()
    parts = dict(list(claims.groupby("item", sort=False)))
    for row in published.itertuples():
        said = {"paper": paper, "item": row.item, "kind": row.kind}
        if row.kind == "value":
            key = tuple(getattr(row, name) for name in KEYS)
            if key not in index.index:
                raise ReproError(f"{source}: {row.item}: no table has a row for {', '.join(key)}")
            verdict = compare_value(
                float(row.value), int(row.digits), int(row.trials), index.loc[key], tolerance
            )
            said |= dict(zip(KEYS, key, strict=True)) | verdict | {"evidence": ""}
        else:
            if row.item not in parts:
                raise ReproError(f"{source}: {row.item}: no claim of this name is tested")
            tested = parts.pop(row.item)
            verdicts = list(tested["verdict"])
            said |= {
                "verdict": overall(verdicts),
                "statement": tested["statement"].iloc[0],
                "evidence": _evidence(tested),
            }
        yield said | {
            "expect": row.expect,
            "as_expected": said["verdict"] == row.expect,
            "reason": row.reason,
        }
    if parts:
        raise ReproError(f"{source}: the tested claim '{next(iter(parts))}' has no row here")


def _evidence(parts: pd.DataFrame) -> str:
    counts = parts["verdict"].value_counts()
    said = ", ".join(f"{counts[v]} {v}" for v in VERDICTS["claim"] if v in counts)
    ratio = parts["difference"] / parts["mcse"].clip(lower=1e-300)
    worst = parts.loc[ratio.fillna(-np.inf).idxmax()]
    return (
        f"{len(parts)} comparisons: {said}; least favourable: {worst['part']}: "
        f"{worst['difference']:.4g} ± {worst['mcse']:.2g}"
    )


def diff(papers: dict[str, dict], tolerance: float) -> pd.DataFrame:
    """Every published value and claim of all papers with its verdict, one row each.

    `papers` gives for each paper the files `published`, `claims` and `tables`.
    """
    rows = []
    for paper, files in papers.items():
        published = read_published(files["published"])
        tables = pd.concat([pd.read_csv(table) for table in files["tables"]])
        claims = pd.read_csv(files["claims"])
        rows += compare(paper, published, tables, claims, tolerance, files["published"])
    return pd.DataFrame(rows)


def verify(csv: str | Path) -> None:
    """Raise ReproError if a verdict is not the expected one; the message names each."""
    table = pd.read_csv(csv)
    surprises = table[~table["as_expected"]]
    if len(surprises):
        said = "; ".join(
            f"{row.paper}, {row.item}: {row.verdict}, expected {row.expect}"
            for row in surprises.itertuples()
        )
        raise ReproError(f"{csv}: {said}")
