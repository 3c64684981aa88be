"""Which published order of the censored network's filters survives which unstated assumption."""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from repro.parameters.load import ON_REQUEST, on_request
from repro.statistics import metrics
from repro.studies.families import censored_network as study
from repro.tables.csv_file import write_csv
from repro.tables.results import Results
from repro.verdicts.claims import Part

ORDERS = (
    ("mapf", "mapf_nc"),
    ("mapf_nc", "mapf_nmc"),
    ("mapf", "mpf"),
    ("mapf", "dead_reckoning"),
)


class Reading(NamedTuple):
    """One changed assumption: the point that was run with it, or how its errors are averaged."""

    name: str
    point: str
    steps: slice = slice(1, None)
    average: Callable = study.mean_of_roots
    trials: int | None = None  # the first of them; all if None


# These need no runs of their own.
OF_THE_METRIC = (
    Reading("base", "base"),
    Reading(f"horizon={study.HORIZON}", "base", steps=slice(1, study.HORIZON + 1)),
    Reading("average_from=0", "base", steps=slice(0, None)),
    Reading("average_kind=root_of_mean", "base", average=study.root_of_mean),
)


def tabulate(results: Results, name: str, path: str | Path) -> None:
    """Average RMSE of each filter under each reading, and whether each order holds (paired)."""
    points = [point for point in results.catalogue[name] if on_request(point)]
    fewest = min(len(results.runs(name, point, "mapf").error) for point in points)
    readings = (
        *OF_THE_METRIC,
        Reading("base of the same runs", "base", trials=fewest),  # the runs that the readings have
        *(Reading(point.removeprefix(ON_REQUEST), point) for point in points),
    )
    rows = []
    for reading in readings:
        found = {
            filter_: _average(results, name, reading, filter_)
            for filter_ in results.filters(name, reading.point)
        }
        where = {"study": name, "reading": reading.name}
        for filter_, (value, left_out) in found.items():
            rows.append(
                where
                | {"filter": filter_, "metric": "rmse", "value": value}
                | {"mcse": metrics.jackknife_error(left_out), "trials": len(left_out)}
            )
        for first, second in ORDERS:
            (a, a_left), (b, b_left) = found[first], found[second]
            error = float(metrics.jackknife_error(a_left - b_left))
            part = Part(f"{first} < {second}", float(a - b), error)
            rows.append(
                where
                | {"filter": part.what, "metric": "order", "value": part.difference}
                | {
                    "mcse": part.mcse,
                    "trials": len(a_left),
                    "verdict": part.verdict(results.tolerance),
                }
            )
    write_csv(rows, path)


def _average(results: Results, name: str, reading: Reading, filter_: str):
    """Average over the targets of the time-averaged RMSE, and with one run left out each."""
    squared = study.squared_distance(results.runs(name, reading.point, filter_))
    squared = squared[: reading.trials, reading.steps]
    left_out = metrics.leave_one_out(squared, reading.average)
    return reading.average(squared.mean(axis=0))[-1], np.asarray(left_out)[:, -1]
