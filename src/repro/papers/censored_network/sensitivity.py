"""Which published order of the filters of censored_network survives which unstated assumption."""

from functools import partial
from pathlib import Path

from repro.papers.censored_network.time_averages import (
    OTHER_AVERAGES,
    POINT,
    Average,
    first_trials,
    time_average,
)
from repro.parameters.point_names import ON_REQUEST, is_reading
from repro.statistics import metrics
from repro.tables.csv_file import write_csv
from repro.tables.results import Results
from repro.verdicts.claims import Part

ORDERS = (
    ("mapf", "mapf_nc"),
    ("mapf_nc", "mapf_nmc"),
    ("mapf", "mpf"),
    ("mapf", "dead_reckoning"),
)


def tabulate(results: Results, study: str, path: str | Path) -> None:
    """Average RMSE of each filter under each reading, and whether each order holds (paired)."""
    rows = []
    for reading, (point, average) in _readings(results, study).items():
        averages = {
            filter_: average(results, study, filter_) for filter_ in results.filters(study, point)
        }
        key = {"study": study, "reading": reading}
        for filter_, of_filter in averages.items():
            rows.append(
                key
                | {"filter": filter_, "metric": "rmse", "value": of_filter.value[-1]}
                | {"mcse": of_filter.mcse()[-1], "trials": len(of_filter.left_out)}
            )
        for first, second in ORDERS:
            a, b = averages[first], averages[second]
            error = metrics.jackknife_error((a.left_out - b.left_out)[:, -1])
            part = Part(f"{first} < {second}", (a.value - b.value)[-1], float(error))
            rows.append(
                key
                | {"filter": part.name, "metric": "order", "value": part.difference}
                | {"mcse": part.mcse, "trials": len(a.left_out)}
                | {"verdict": part.verdict(results.tolerance)}
            )
    write_csv(rows, path)


def _readings(results: Results, study: str) -> dict[str, tuple[str, Average]]:
    """Point and average by name: those of the metric, which need no runs, and those of points."""
    points = [point for point in results.catalogue[study] if is_reading(point)]
    fewest = min(results.in_shards(study, point, "mapf").trials for point in points)
    same_runs = partial(time_average, average=first_trials(fewest))
    return (
        {"base": (POINT, time_average)}
        | {words: (POINT, average) for words, average in OTHER_AVERAGES.items()}
        | {"base, as few runs": (POINT, same_runs)}
        | {_short(point): (point, partial(time_average, point=point)) for point in points}
    )


def _short(point: str) -> str:
    return point.removeprefix(ON_REQUEST).removeprefix("reading-")
