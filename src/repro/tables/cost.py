"""Error over the CPU time that it costs, of every filter and every number of particles."""

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from repro.parameters.point_names import is_plain
from repro.tables.csv_file import write_csv

COLUMNS = [
    *("study", "where", "point", "filter", "particles", "cpu_us_per_step", "error", "mcse", "lost")
]


def write_cost(
    times: pd.DataFrame, ranking: str, convergence: str | None, path: str | Path
) -> None:
    """Write a row a filter and point, given the files of a study's ranking and convergence.

    `times` are those of `repro.workflow.timings.filter_times`, of one trial and step.
    """
    rows = [*_of_filters(pd.read_csv(ranking))]
    if convergence:
        rows += _of_particles(pd.read_csv(convergence))
    of_jobs = {
        (row["study"], row["point"], row["filter"]): row["cpu_us_per_step"]
        for row in times.to_dict("records")
    }
    for row in rows:
        row["cpu_us_per_step"] = of_jobs.get((row["study"], row["point"], row["filter"]), np.nan)
    write_csv(pd.DataFrame(rows, columns=COLUMNS), path)


def _of_filters(ranking: pd.DataFrame) -> Iterator[dict[Any, Any]]:
    """The paper's own points; those that sweep particles are among the others' rows."""
    for row in ranking.to_dict("records"):
        if is_plain(row["point"]) and "particles=" not in row["point"]:
            yield row | {"where": row["point"], "particles": None}


def _of_particles(convergence: pd.DataFrame) -> Sequence[dict[Any, Any]]:
    return convergence.to_dict("records")
