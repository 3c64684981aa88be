"""Every verdict again under every reading of what its paper leaves open."""

from collections.abc import Iterable, Iterator, Mapping
from importlib import import_module
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from repro.tables.csv_file import write_csv
from repro.tables.results import Results
from repro.tables.under_reading import UnderReading
from repro.verdicts.claims import Claim, Part, overall
from repro.verdicts.published import KEYS, compare_value, read_published
from repro.verdicts.standing import NEEDS_NONE, NOT_RUN

COLUMNS = [
    *("paper", "item", "kind", "reading", "changes", "points", "verdict", "margin", "trials")
]
EXACT, MEASURED = "exact", "measured elsewhere"  # why no reading concerns a verdict
# What a test raises that finds no such point, filter or value of a sweep, no first of them, or not
# two to compare; all are there on the ordinary points.
TOO_FEW = (LookupError, StopIteration, ValueError)


class Ordinary(NamedTuple):
    """What a claim asks for on the ordinary points, and the comparisons that it gives there."""

    parts: list[Part]
    studies: set[str]
    runs: bool  # whether it asks for runs or logs, not for parameters alone
    parameters: set[tuple[str, str]]  # study and point of those that it asks for

    @property
    def needs_none(self) -> str:
        """Why no reading concerns a claim that asks for no run."""
        return EXACT if all(part.mcse == 0 for part in self.parts) else MEASURED


def judge(
    results: Results,
    paper: str,
    readings: Mapping[str, Mapping[str, Mapping[str, Any]]],
    published: str,
    path: str | Path,
) -> None:
    """Write the verdicts of a paper's values and claims under the readings of its studies.

    `readings` are those of each study, as `readings_of` gives them; of one name, they are taken
    together. A row for each value or claim that a reading concerns: `margin` is how many standard
    errors the least favourable comparison is above no difference, or a value above the printed one.
    What no reading can concern has a row that says so.
    """
    claims: list[Claim] = import_module(f"repro.papers.{paper}.claims").CLAIMS
    ordinary = _ordinary(results, claims)
    values = read_published(published)
    values = values.loc[values["kind"] == "value"]
    rows = []
    for reading in dict.fromkeys(name for of_study in readings.values() for name in of_study):
        of_studies = {
            study: found[reading] for study, found in readings.items() if reading in found
        }
        changes = {name: v for of in of_studies.values() for name, v in of["changes"].items()}
        view = UnderReading(results, {study: of["points"] for study, of in of_studies.items()})
        changed = ", ".join(f"{name} = {value}" for name, value in changes.items())
        where = {"paper": paper, "reading": reading, "changes": changed}
        concerned = [one for one in claims if ordinary[one.item].studies & of_studies.keys()]
        found = [*_values(view, of_studies, values), *_claims(view, concerned, changes, ordinary)]
        rows += [where | row for row in found]
    judged = {row["item"] for row in rows if row["verdict"] != NOT_RUN}
    rows += [
        {"paper": paper, "item": item, "kind": kind, "changes": why, "verdict": NEEDS_NONE}
        for item, kind, why in _beyond_readings(results, ordinary, values)
        if item not in judged
    ]
    write_csv(pd.DataFrame(rows, columns=COLUMNS), path)


def _beyond_readings(
    results: Results, ordinary: Mapping[str, Ordinary], values: pd.DataFrame
) -> Iterator[tuple[str, str, str]]:
    """Name, kind and reason of what comes from no run: a computed value, an exact claim ..."""
    for row in values.to_dict("records"):
        if row["study"] not in results.catalogue:
            yield row["item"], "value", EXACT
    for item, of_claim in ordinary.items():
        if not of_claim.runs:
            yield item, "claim", of_claim.needs_none


def _ordinary(results: Results, claims: Iterable[Claim]) -> dict[str, Ordinary]:
    """What each claim asks for, and gives, on the ordinary points."""
    as_they_are = {study: {p: p for p in points} for study, points in results.catalogue.items()}
    view, asked = UnderReading(results, as_they_are), {}
    for item, _, test in claims:
        view.used.clear()
        view.parameters_used.clear()
        parts = list(test(view))
        studies = {key[0] for key in view.used or view.parameters_used}
        asked[item] = Ordinary(parts, studies, bool(view.used), set(view.parameters_used))
    return asked


def _values(
    view: UnderReading, studies: Iterable[str], published: pd.DataFrame
) -> Iterator[dict[str, Any]]:
    ours = {
        tuple(row[key] for key in KEYS): row
        for study in studies
        for row in view.table(study).to_dict("records")
    }
    for row in published.to_dict("records"):
        at = ours.get(tuple(row[key] for key in KEYS))
        if at is not None:
            compared = compare_value(
                float(row["value"]), int(row["digits"]), int(row["trials"]), at, view.tolerance
            )
            yield {
                "item": row["item"],
                "kind": "value",
                "points": row["point"],
                "verdict": compared["verdict"],
                "margin": compared["z"],
                "trials": at["trials"],
            }


def _claims(
    view: UnderReading,
    claims: Iterable[Claim],
    changes: Mapping[str, Any],
    ordinary: Mapping[str, Ordinary],
) -> Iterator[dict[str, Any]]:
    """A reading of some filters' settings alone concerns the claims that look at these filters.

    It concerns a claim that asks for no run if it changes a comparison of the same points.
    """
    filters = {name.partition(".")[0] for name in changes if "." in name}
    of_filters = len(filters) > 0 and all("." in name for name in changes)
    for item, _, test in claims:
        view.used.clear()
        view.parameters_used.clear()
        try:
            parts = list(test(view))
        except TOO_FEW:
            parts = []
        if not parts:
            yield {"item": item, "kind": "claim", "verdict": NOT_RUN}
            continue
        points, used = ({key[i] for key in view.used} for i in (1, 2))
        if not ordinary[item].runs:
            points = {point for _, point in view.parameters_used}
            of_same_points = view.parameters_used == ordinary[item].parameters
            if not of_same_points or parts == ordinary[item].parts:
                continue
        elif not used or (of_filters and not used & filters):
            continue
        yield {
            "item": item,
            "kind": "claim",
            "points": " ".join(sorted(points)),
            "verdict": overall(part.verdict(view.tolerance) for part in parts),
            "margin": float(np.fmax.reduce([part.margin for part in parts])),
            "trials": min(view.used.values(), default=None),
        }
