"""The published values and claims of the papers against ours, and whether they agree."""

import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from repro.errors import ReproError
from repro.statistics.paired import independent_error
from repro.verdicts.claims import OF_TWO_SEEDS, RISKS, overall, possible_overall, risk
from repro.verdicts.facts import filled, read_facts
from repro.verdicts.standing import standing

VERDICTS = {"value": ("match", "differs"), "claim": ("holds", "fails", "undecided")}
REPRODUCED = ("match", "holds")
ON_EDGE = "On the edge: our number is so near the limit that another root seed may decide otherwise"
KEYS = ["study", "point", "filter", "metric", "component"]
DIFF_COLUMNS = [
    *("paper", "item", "kind", *KEYS, "published", "ours", "mcse", "their_error", "allowed", "z"),
    *("allowed_percent", "margin", "class", "verdict", "standing", "evidence", "expect"),
    *("as_expected", "on_edge", "seed_risk", "reason", "statement", "figure"),
]
# `figure` is the script in figures/<paper>/ that shows it; empty where no figure does.
COLUMNS = [
    "item",
    *KEYS,
    "value",
    "digits",
    "kind",
    "class",
    "trials",
    "figure",
    "expect",
    "reason",
]
# Of evidence: an exact equality or count; agreement with numbers that a parameter was chosen on; a
# test that could have failed; one that could have, but rests on an assumed layout or horizon.
CLASSES = ("identity", "fitted", "predicted", "conditional")


def read_published(path: str | Path) -> pd.DataFrame:
    """A paper's published values and claims, checked; raises ReproError in one line."""
    try:
        rows = pd.read_csv(path, keep_default_na=False, dtype=str)
    except (OSError, ValueError) as error:
        raise ReproError(f"{path}: cannot be read: {error}") from None
    if list(rows.columns) != COLUMNS:
        raise ReproError(f"{path}: the columns must be {', '.join(COLUMNS)}")
    for i, row in enumerate(rows.to_dict("records"), start=2):
        where, kind, expect = f"{path}: line {i} ({row['item']})", row["kind"], row["expect"]
        if kind not in VERDICTS:
            raise ReproError(f"{where}: kind '{kind}' is not one of {', '.join(VERDICTS)}")
        if row["class"] not in CLASSES:
            raise ReproError(f"{where}: class '{row['class']}' is not one of {', '.join(CLASSES)}")
        if expect not in VERDICTS[kind]:
            raise ReproError(
                f"{where}: expect '{expect}' is not one of {', '.join(VERDICTS[kind])}"
            )
        if expect not in REPRODUCED and not row["reason"]:
            raise ReproError(f"{where}: expect '{expect}' needs a reason")
        if kind == "value":
            for name in ("value", "digits", "trials"):
                try:
                    float(row[name])
                except ValueError:
                    raise ReproError(f"{where}: {name} must be a number") from None
    return rows


def compare_value(
    published: float, digits: int, their_trials: int, ours: Mapping[str, Any], tolerance: float
) -> dict[str, Any]:
    """One published value against our statistic, with its `value`, `mcse` and `trials`.

    The paper states no standard error: we take our spread over trials at its number of trials.
    Within `tolerance` standard errors of both, plus half the last printed digit: match.
    """
    value, mcse = float(ours["value"]), float(ours["mcse"])
    their_error = mcse * float(np.sqrt(ours["trials"] / their_trials))
    error = independent_error(mcse, their_error)
    rounding = 0.5 * 10.0**-digits
    difference = value - published
    allowed = tolerance * error + rounding
    return {
        "published": published,
        "ours": value,
        "mcse": mcse,
        "their_error": their_error,
        "allowed": allowed,
        "allowed_percent": 100 * allowed / abs(published) if published else np.nan,
        "z": difference / error if error > 0 else np.nan,
        "verdict": "match" if abs(difference) <= allowed else "differs",
        "on_edge": abs(abs(difference) - allowed) <= tolerance * OF_TWO_SEEDS * mcse,
    }


def value_risk(expect: str, compared: Mapping[str, Any], tolerance: float) -> float:
    """Probability that with a fresh root seed a value's verdict cannot be the expected one.

    That is if its number is beyond the limit by more than `tolerance` errors of a difference of two
    seeds' numbers; it is ours plus two errors' worth: that of ours and its own.
    """
    beyond = abs(compared["ours"] - compared["published"]) - compared["allowed"]
    beyond *= 1 if expect == "match" else -1
    if compared["mcse"] == 0 or not np.isfinite(beyond):
        return float(not beyond <= 0)
    return 0.5 * math.erfc((tolerance * OF_TWO_SEEDS - beyond / compared["mcse"]) / 2.0)


def compare(
    paper: str,
    published: pd.DataFrame,
    tables: pd.DataFrame,
    claims: pd.DataFrame,
    tolerance: float,
    source: str,
    robustness: pd.DataFrame | None = None,
    facts: Mapping[str, float] | None = None,
) -> Iterator[dict[str, Any]]:
    """Rows of the diff of one paper, in the order of its published file.

    `margin` is the z of a value, or how many standard errors the least favourable comparison of a
    claim is above no difference.

    A verdict is on the edge if another root seed may give another one: if moving our number by
    `tolerance` errors of a difference of two seeds' numbers does. It is as expected if the expected
    one is among those.
    Raises ReproError, naming the `source` file, for a row without a result or a claim without row.
    """
    ours = {tuple(row[name] for name in KEYS): row for row in tables.to_dict("records")}
    parts_of = dict(list(claims.groupby("item", sort=False)))
    for row in published.to_dict("records"):
        item = row["item"]
        compared = {"paper": paper, "item": item, "kind": row["kind"], "class": row["class"]}
        if row["kind"] == "value":
            key = tuple(row[name] for name in KEYS)
            if key not in ours:
                raise ReproError(f"{source}: {item}: no table has a row for {', '.join(key)}")
            verdict = compare_value(
                float(row["value"]), int(row["digits"]), int(row["trials"]), ours[key], tolerance
            )
            compared |= dict(zip(KEYS, key, strict=True)) | verdict
            compared |= {"evidence": "", "margin": verdict["z"]}
            possible = set(VERDICTS["value"]) if verdict["on_edge"] else {verdict["verdict"]}
            seed_risk = value_risk(row["expect"], verdict, tolerance)
        else:
            if item not in parts_of:
                raise ReproError(f"{source}: {item}: no claim of this name is tested")
            parts = parts_of.pop(item)
            compared |= {
                "verdict": overall(parts["verdict"]),
                "on_edge": len(possible := possible_overall(parts["possible"].str.split())) > 1,
                "statement": parts["statement"].iloc[0],
                "evidence": _evidence(parts),
                "margin": parts["margin"].max(),
            }
            seed_risk = risk(row["expect"], {name: parts[name].to_numpy() for name in RISKS})
        of_item = None if robustness is None else robustness.loc[robustness["item"] == item]
        yield compared | {
            "figure": row["figure"],
            "expect": row["expect"],
            "as_expected": row["expect"] in possible,
            "seed_risk": seed_risk,
            "standing": "" if of_item is None else standing(compared["verdict"], of_item),
            "reason": filled(row["reason"], facts or {}, f"{source}: {item}")
            or ON_EDGE * (len(possible) > 1),
        }
    if parts_of:
        raise ReproError(f"{source}: the tested claim '{next(iter(parts_of))}' has no row here")


def _evidence(parts: pd.DataFrame) -> str:
    """How many comparisons decide what, and the least favourable one."""
    counts = parts["verdict"].value_counts()
    tally = ", ".join(f"{counts[v]} {v}" for v in VERDICTS["claim"] if v in counts)
    worst = parts.sort_values(["margin", "difference"], na_position="first").iloc[-1]
    return (
        f"{len(parts)} comparisons: {tally}; least favourable: {worst['part']}: "
        f"{worst['difference']:.4g} ± {worst['mcse']:.2g}"
    )


def diff(papers: Mapping[str, Mapping[str, Any]], tolerance: float) -> pd.DataFrame:
    """Every published value and claim of all papers with its verdict, one row each.

    `papers` gives for each paper the files `published`, `claims`, `facts`, `robustness`, `tables`.
    """
    rows = []
    for paper, files in papers.items():
        published = read_published(files["published"])
        tables = pd.concat([pd.read_csv(table) for table in files["tables"]])
        claims, facts = pd.read_csv(files["claims"]), read_facts(files["facts"])
        robustness = pd.read_csv(files["robustness"])
        rows += compare(
            paper, published, tables, claims, tolerance, files["published"], robustness, facts
        )
    return pd.DataFrame(rows, columns=DIFF_COLUMNS)


def verify(csv: str | Path) -> None:
    """Raise ReproError if a verdict is not the expected one; the message names each."""
    table = pd.read_csv(csv)
    surprises = table.loc[~table["as_expected"]].to_dict("records")
    if surprises:
        named = "; ".join(
            f"{row['paper']}, {row['item']}: {row['verdict']}, expected {row['expect']} "
            f"({row['class']}, {_margin(row['margin'])})"
            for row in surprises
        )
        raise ReproError(f"{csv}: {named}")


def _margin(margin: float) -> str:
    return f"margin {margin:+.1f} standard errors" if np.isfinite(margin) else "exact"
