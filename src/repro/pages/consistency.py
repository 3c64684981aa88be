"""Who can be trusted, and how near the filters are to the best possible: sentences of a paper."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from repro import plugins
from repro.atomic import atomic_write

VERDICTS = {
    "consistent": "true within the bounds",
    "overconfident": "too small",
    "cautious": "too large",
    "undecided": "undecided at so many runs",
}


def write_summary(
    rows: Iterable[Mapping[str, Any]], bounds: Sequence[Mapping[str, Any]], path: str | Path
) -> None:
    """Write a sentence on the paper and some on each study and point, from rows over all steps.

    `bounds` are the rows of `repro.tables.bounds` for the filters that the paper proposes.
    """
    judged = [row for row in rows if row["metric"] in ("nees", "claimed_over_true")]
    of_points: dict[tuple[str, str], list[Mapping[str, Any]]] = {}
    for row in judged:
        of_points.setdefault((row["study"], row["point"]), []).append(row)
    nees = [row for row in judged if row["metric"] == "nees"]
    counts = [
        f"{sum(row['verdict'] == verdict for row in nees)} {meaning}"
        for verdict, meaning in VERDICTS.items()
        if any(row["verdict"] == verdict for row in nees)
    ]
    text = "No filter claims a covariance at the points where they are judged.\n"
    if nees:
        text = f"Of {len(nees)} covariances that filters claim, {_listed(counts)}.\n\n"
    for (study, point), found in of_points.items():
        text += f"- `{study}`, `{point}`. {_sentences(found)}"
        text += _nearest([row for row in bounds if (row["study"], row["point"]) == (study, point)])
        text += "\n"
    with atomic_write(path) as part:
        part.write_text(text, encoding="utf-8")


def _sentences(rows: list[Mapping[str, Any]]) -> str:
    """Of one point: the filters by verdict, and the claims that are furthest from the errors."""
    nees = [row for row in rows if row["metric"] == "nees"]
    claims = [row for row in rows if row["metric"] == "claimed_over_true"]
    groups = []
    for verdict, meaning in VERDICTS.items():
        named = [_named(row, nees) for row in nees if row["verdict"] == verdict]
        if named:
            groups.append(f"{meaning}: {_listed(named)}")
    text = f"Covariance {'; '.join(groups)}."
    least, most = (f(claims, key=lambda row: row["value"]) for f in (min, max))
    text += f" The mean square error that {_label(least)} claims is {least['value']:.3g}"
    if most is least:
        return f"{text} times the true one."
    return f"{text}, and that of {_label(most)} {most['value']:.3g}, times the true one."


def _nearest(rows: list[Mapping[str, Any]]) -> str:
    """For each bound of a point: the filter that is nearest to it."""
    text = ""
    for bound in dict.fromkeys((row["bound"], row["component"]) for row in rows):
        of_bound = [row for row in rows if (row["bound"], row["component"]) == bound]
        known = [row for row in of_bound if row["ratio"] == row["ratio"]]
        if known:
            best = min(known, key=lambda row: row["ratio"])
            text += (
                f" The bound of the {bound[1]} ({bound[0]}) is {best['least']:.3g}; of the "
                f"paper's filters {_label(best)} is nearest with {best['ratio']:.3g} times that."
            )
    return text


def _named(row: Mapping[str, Any], rows: list[Mapping[str, Any]]) -> str:
    """A filter, its NEES, and where it has several what it is of."""
    of = f" of {row['component']}" if len({other["component"] for other in rows}) > 1 else ""
    return f"{_label(row)} (NEES{of} {row['value']:.3g})"


def _label(row: Mapping[str, Any]) -> str:
    return plugins.filter_module(row["filter"]).LABEL


def _listed(names: list[str]) -> str:
    *first, last = names
    return f"{', '.join(first)} and {last}" if first else last
