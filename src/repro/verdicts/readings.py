"""Other readings of a paper: what each changes, and what comes out under it."""

from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np
import pandas as pd

from repro.parameters.point_names import is_reading
from repro.parameters.readings import Points, base_of
from repro.statistics.paired import independent_error
from repro.verdicts.published import KEYS, compare_value

IDENTITY = ("filter", "metric", "component")  # of a statistic of a point


class Reading(NamedTuple):
    """One statistic of one filter under a reading, and under the point that it is a reading of."""

    changes: dict[str, Any]  # values of the reading that differ from the base
    base: str  # the point
    filter: str
    metric: str
    component: str
    base_value: float
    base_mcse: float
    value: float
    mcse: float
    z: float  # difference to the base in standard errors of both
    published: str  # as printed; empty if the paper has no value for the base
    base_verdict: str  # against the published value, or empty
    verdict: str


def readings(
    table: pd.DataFrame, published: pd.DataFrame, points: Points, tolerance: float
) -> Iterator[Reading]:
    """The statistics of a study's table that a reading changes.

    These are the ones with a published value, and those of the table's first metric.
    """
    printed = {
        tuple(row[key] for key in KEYS[1:]): row
        for row in published.to_dict("records")
        if row["kind"] == "value"
    }
    first_metric = table["metric"].iloc[0]
    statistics: dict[str, dict[tuple[str, ...], dict]] = {}
    for row in table.to_dict("records"):
        key = tuple(row[name] for name in IDENTITY)
        statistics.setdefault(row["point"], {})[key] = row
    for point in points:
        if not is_reading(point):
            continue
        base, changes = base_of(point, points)
        at_base = statistics.get(base, {})
        for key, ours in statistics.get(point, {}).items():
            there = at_base.get(key)
            if there is None or there["value"] == ours["value"]:
                continue  # the reading does not concern this filter
            row = printed.get((base, *key))
            if row is None and key[1] != first_metric:
                continue
            yield Reading(
                changes,
                base,
                *key,
                base_value=there["value"],
                base_mcse=there["mcse"],
                value=ours["value"],
                mcse=ours["mcse"],
                z=float(
                    np.divide(
                        ours["value"] - there["value"],
                        independent_error(ours["mcse"], there["mcse"]),
                    )
                ),
                published="" if row is None else row["value"],
                base_verdict=_verdict(row, there, tolerance),
                verdict=_verdict(row, ours, tolerance),
            )


def _verdict(row: Mapping[str, str] | None, ours: Mapping[str, Any], tolerance: float) -> str:
    if row is None:
        return ""
    return compare_value(
        float(row["value"]), int(row["digits"]), int(row["trials"]), ours, tolerance
    )["verdict"]
