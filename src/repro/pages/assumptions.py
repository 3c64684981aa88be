"""What the papers left out: every assumed value, and what other readings of it would change."""

import re
from pathlib import Path

import numpy as np
import pandas as pd

from repro.atomic import atomic_write
from repro.parameters.load import on_request, sources
from repro.verdicts.published import compare_value, read_published

IDENTITY = ["filter", "metric", "component"]
READING = re.compile(r"(^|-)(reading|as-printed|sensitivity)-")  # in a point's name
NOT_A_READING = {"trials"}  # differs between points without being an assumption about the paper


def flat(point: dict) -> dict:
    """Parameters and settings of a point under one kind of name."""
    settings = {
        f"{filter_}.{name}": value
        for filter_, values in point["filters"].items()
        for name, value in values.items()
    }
    return {k: v for k, v in point["parameters"].items() if k not in NOT_A_READING} | settings


def base_of(point: str, points: dict[str, dict], readings: list[str]) -> tuple[str, dict]:
    """The point that a reading is a reading of, and what the reading changes.

    It is the point, no reading itself, that differs in the fewest values.
    """
    own = flat(points[point])
    changes = {}
    for other, content in points.items():
        if other not in readings:
            values = flat(content)
            changes[other] = {k: v for k, v in own.items() if values.get(k) != v}
    base = min(changes, key=lambda other: len(changes[other]))
    return base, changes[base]


def reading_rows(table: pd.DataFrame, published: pd.DataFrame, points: dict, tolerance: float):
    """One row for each reading, filter and metric: its value, the base's, and the verdicts."""
    readings = [point for point in points if READING.search(point)]
    known = published[published["kind"] == "value"].set_index(["point", *IDENTITY])
    first_metric = table["metric"].iloc[0]
    by_point = {point: rows.set_index(IDENTITY) for point, rows in table.groupby("point")}
    for reading in readings:
        base, changed = base_of(reading, points, readings)
        if reading not in by_point or base not in by_point:
            continue
        for key, ours in by_point[reading].iterrows():
            if key not in by_point[base].index:
                continue
            there = by_point[base].loc[key]
            if there["value"] == ours["value"]:
                continue  # the reading is no matter of this filter
            printed = known.loc[(base, *key)] if (base, *key) in known.index else None
            if printed is None and key[1] != first_metric:
                continue
            yield {
                "reading": ", ".join(f"{k} = {v}" for k, v in changed.items()),
                "base": base,
                **dict(zip(IDENTITY, key, strict=True)),
                "base value": f"{there['value']:.4g} ± {there['mcse']:.2g}",
                "under the reading": f"{ours['value']:.4g} ± {ours['mcse']:.2g}",
                "z": (ours["value"] - there["value"]) / np.hypot(ours["mcse"], there["mcse"]),
                "published": "" if printed is None else printed["value"],
                "verdict, base": _verdict(printed, there, tolerance),
                "verdict, reading": _verdict(printed, ours, tolerance),
            }


def _verdict(printed, ours: pd.Series, tolerance: float) -> str:
    if printed is None:
        return ""
    return compare_value(
        float(printed["value"]), int(printed["digits"]), int(printed["trials"]), ours, tolerance
    )["verdict"]


def write_assumptions(papers: dict[str, dict], tolerance: float, path: str | Path) -> None:
    """Write the page.

    `papers` gives for each paper the files `parameters` and `published`, `studies` (study -> its
    resolved points) and `tables` (study -> the file of its table).
    """
    text = [
        "# What the papers left out",
        "",
        "Every value that a paper does not state, why it was chosen, and what other readings of",
        "the text would change. Made from `params/` and the tables by the run.",
        "",
    ]
    for paper, files in papers.items():
        text += [f"## {paper}", "", "| study | parameter | value | why |", "|---|---|---|---|"]
        for row in sources(files["parameters"]):
            if row["source"] == "assumed" and row["point"] == "every":
                value = row["value"] if len(row["value"]) < 60 else row["value"][:57] + "..."
                text.append(f"| {row['study']} | `{row['parameter']}` | {value} | {row['why']} |")
        text.append("")
        published = read_published(files["published"])
        for study, points in files["studies"].items():
            table = pd.read_csv(files["tables"][study])
            of_study = published[published["study"] == study]
            rows = list(reading_rows(table, of_study, points, tolerance))
            if rows:
                text += [f"### Readings of {study}", "", _table(rows), ""]
            asked = [point for point in points if on_request(point)]
            if asked:
                text += [
                    f"{len(asked)} more readings of {study} run on request and are drawn in "
                    f"`figures/{paper}/sensitivity.png`, which is a target of its own.",
                    "",
                ]
    with atomic_write(path) as part:
        part.write_text("\n".join(text))


def _table(rows: list[dict]) -> str:
    lines = ["| " + " | ".join(rows[0]) + " |", "|" + "---|" * len(rows[0])]
    for row in rows:
        cells = (f"{v:+.1f}" if isinstance(v, float) else str(v) for v in row.values())
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)
