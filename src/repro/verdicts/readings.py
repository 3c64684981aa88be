"""Which numbers another reading of a paper moves, and how far."""

from collections.abc import Iterator

import numpy as np
import pandas as pd

from repro.parameters.readings import Points, readings_of
from repro.statistics.paired import independent_error
from repro.verdicts.published import KEYS

IDENTITY = KEYS[2:]  # of a statistic of a point: filter, metric and component


def moved(
    table: pd.DataFrame, published: pd.DataFrame, points: Points
) -> Iterator[tuple[str, float]]:
    """Reading, and difference to the base in standard errors of both, of each number it changes.

    The numbers are those of the study's `table` that have a published value, and those of the
    table's first metric; what is the same under the reading, it does not concern.
    """
    values = published.loc[published["kind"] == "value"]
    printed = set(values[KEYS[1:]].itertuples(index=False, name=None))
    first_metric = table["metric"].iloc[0]
    statistics: dict[str, dict[tuple[str, ...], dict]] = {}
    for row in table.to_dict("records"):
        key = tuple(row[name] for name in IDENTITY)
        statistics.setdefault(row["point"], {})[key] = row
    for reading, of_reading in readings_of(points).items():
        for base, point in of_reading["points"].items():
            at_base = statistics.get(base, {})
            for key, ours in statistics.get(point, {}).items():
                there = at_base.get(key)
                if there is None or there["value"] == ours["value"]:
                    continue
                if key[1] == first_metric or (base, *key) in printed:
                    error = independent_error(ours["mcse"], there["mcse"])
                    yield reading, float(np.divide(ours["value"] - there["value"], error))
