"""What it costs a filter to take a parameter of the network for another than it is."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from repro import plugins
from repro.network.energy_harvesting import transmission_probability
from repro.parameters.point_names import own_table
from repro.parameters.settings import ASSUMED
from repro.statistics import metrics
from repro.statistics.paired import decided
from repro.studies.families import harvesting_sensors
from repro.studies.families.harvesting_sensors import HarvestingParameters
from repro.tables.csv_file import write_csv
from repro.tables.results import Results
from repro.tables.study_tables import share_lost


def write_mismatch(results: Results, study: str, path: str) -> None:
    """Write the error of every filter with every wrong value, relative to that with the right one.

    Both are of the same trials, so that their difference is paired.
    """
    write_csv(list(_rows(results, study)), path)


def _rows(results: Results, study: str) -> Iterator[dict[str, Any]]:
    scenario, analysis = plugins.study(study), results.analysis(study)
    points = [point for point in results.points(study) if own_table(point) == "mismatch"]
    true = {point: results.parameters(study, point) for point in points}
    right = {  # of the filters of each log, those that assume nothing wrong
        (results.log_of(study, point), filter_): point
        for point in points
        for filter_ in results.filters(study, point)
        if true[point] == _believed(true[point], _assumed(results, study, point, filter_))
    }
    for point in points:
        for filter_ in results.filters(study, point):
            base = right[results.log_of(study, point), filter_]
            wrong, known = (
                results.rmse(study, p, filter_, scenario.squared_error, True) for p in (point, base)
            )
            difference = wrong.value - known.value
            mcse = float(metrics.jackknife_error(wrong.left_out - known.left_out))
            believed = _believed(true[point], _assumed(results, study, point, filter_))
            (name,) = _assumed(results, study, point, filter_)
            parameter, truth, assumed = _in_numbers(name, true[point], believed)
            shards, of_base = (results.in_shards(study, p, filter_) for p in (point, base))
            yield {
                "study": study,
                "truth_of": results.log_of(study, point),
                "point": point,
                "filter": filter_,
                "parameter": parameter,
                "true": truth,
                "assumed": assumed,
                "trials": shards.trials,
                "error": wrong.value,
                "mcse": float(metrics.jackknife_error(wrong.left_out)),
                "relative": wrong.value / known.value,
                "relative_mcse": float(metrics.jackknife_error(wrong.left_out / known.left_out)),
                "relative_median": float(np.median(wrong.single) / np.median(known.single)),
                "difference": difference,
                "difference_mcse": mcse,
                "verdict": decided(difference, mcse, results.tolerance),
                "lost": share_lost(scenario, analysis, shards),
                "lost_if_right": share_lost(scenario, analysis, of_base),
            }


def _assumed(results: Results, study: str, point: str, filter_: str) -> dict[str, Any]:
    """The parameter that a filter's family sweeps, and what the filter takes it for."""
    return {
        key.strip().removeprefix(f"{filter_}.{ASSUMED}"): value
        for keys, value in results.points(study)[point]["swept"].items()
        for key in keys.split(",")
        if key.strip().startswith(f"{filter_}.{ASSUMED}")
    }


def _believed(parameters: Any, assumed: dict[str, Any]) -> Any:
    return type(parameters).checked(parameters.plain() | assumed, "assumed values")


def _in_numbers(name: str, true: Any, believed: Any) -> tuple[str, Any, Any]:
    """Parameter, its true value and the assumed one; of a harvest, the lambda that it gives."""
    if name != "harvest_transition":
        return name, getattr(true, name), getattr(believed, name)
    return "transmission_probability", mean_transmission(true), mean_transmission(believed)


def mean_transmission(parameters: HarvestingParameters) -> float:
    """Mean over k of lambda(k) by Lemma 1 [energy_harvesting (26)], as the filters compute it."""
    queue = harvesting_sensors.queue(parameters)
    of_steps = transmission_probability(queue, parameters.steps, "lemma1")
    return float(np.mean(of_steps[1:]))
