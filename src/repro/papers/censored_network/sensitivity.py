"""Which published order of the filters of censored_network survives which unstated assumption."""

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple

import numpy as np

from repro.papers.censored_network.time_averages import POINT, mean_of_roots, root_of_mean
from repro.parameters.point_names import ON_REQUEST, on_request
from repro.statistics import metrics
from repro.studies.families.censored_network import squared_distance
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
    average: Callable[[np.ndarray], np.ndarray] = mean_of_roots
    trials: int | None = None  # the first of them; all if None


def tabulate(results: Results, study: str, path: str | Path) -> None:
    """Average RMSE of each filter under each reading, and whether each order holds (paired)."""
    rows = []
    for reading in _readings(results, study):
        averages = {
            filter_: _average(results, study, reading, filter_)
            for filter_ in results.filters(study, reading.point)
        }
        key = {"study": study, "reading": reading.name}
        for filter_, (value, left_out) in averages.items():
            rows.append(
                key
                | {"filter": filter_, "metric": "rmse", "value": value}
                | {"mcse": metrics.jackknife_error(left_out), "trials": len(left_out)}
            )
        for first, second in ORDERS:
            (a, a_left), (b, b_left) = averages[first], averages[second]
            error = float(metrics.jackknife_error(a_left - b_left))
            order = f"{first} < {second}"
            part = Part(order, a - b, error)
            rows.append(
                key
                | {"filter": order, "metric": "order", "value": part.difference}
                | {"mcse": part.mcse, "trials": len(a_left)}
                | {"verdict": part.verdict(results.tolerance)}
            )
    write_csv(rows, path)


def _readings(results: Results, study: str) -> list[Reading]:
    """Those of the metric, which need no runs of their own, and those that have been run."""
    horizon = results.analysis(study).short_horizon
    points = [point for point in results.catalogue[study] if on_request(point)]
    fewest = min(results.in_shards(study, point, "mapf").trials for point in points)
    return [
        Reading("base", POINT),
        Reading(f"horizon={horizon}", POINT, steps=slice(1, horizon + 1)),
        Reading("average_from=0", POINT, steps=slice(0, None)),
        Reading("average_kind=root_of_mean", POINT, average=root_of_mean),
        Reading("base of the same runs", POINT, trials=fewest),  # those that the readings have
        *(Reading(point.removeprefix(ON_REQUEST), point) for point in points),
    ]


def _average(
    results: Results, study: str, reading: Reading, filter_: str
) -> tuple[float, np.ndarray]:
    """Average over the targets of the time-averaged RMSE, and with one run left out each."""
    squared = squared_distance(results.runs(study, reading.point, filter_))
    squared = squared[: reading.trials, reading.steps]
    left_out = metrics.leave_one_out(squared, reading.average)
    return float(reading.average(squared.mean(axis=0))[-1]), np.asarray(left_out)[:, -1]
