"""How far every filter is from a lower bound of the errors, in long form, over k and over all.

The bounds are the posterior Cramer-Rao bound with the losses known, which no filter without that
knowledge beats (Tichavsky et al. 1998; averaged over the arrival sequences of the log, Boers and
Driessen 2005), and what the best filter of a kind claims where there is one. The informations are
means over the true states of the log.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pandas as pd

from repro import plugins
from repro.kernels import information as kernels
from repro.statistics import metrics
from repro.statistics.consistency import claimed
from repro.studies import Study
from repro.studies.families.information import Information
from repro.tables.csv_file import write_csv
from repro.tables.results import Results

KNOWN = "Cramer-Rao, losses known"
SHOWN_STEPS = 200  # of a curve over k, at most
COLUMNS = ("study", "point", "component", "bound", "filter", "k", "least", "least_mcse")
COLUMNS += ("error", "error_mcse", "ratio")


def tabulate(results: Results, study: str, path: str) -> list[dict[str, Any]]:
    """Write the bounds of a study beside the RMSE of its filters; returns the rows over all k.

    A row is a root of mean squares at step k, or their mean over k = 1, 2, ... without one.
    """
    rows, curves = [], []
    for point in results.consistency(study):
        errors = _errors(results, study, point)
        for component, bound, least in _bounds(results, study, point):
            for filter_, squared in errors[component].items():
                where = {"study": study, "point": point, "component": component, "bound": bound}
                row, curve = _compared(where | {"filter": filter_}, least, squared)
                rows.append(row)
                curves.append(curve)
    frame = pd.DataFrame(rows, columns=list(COLUMNS))
    write_csv(pd.concat([frame, *curves]) if curves else frame, path)
    return rows


def _errors(results: Results, study: str, point: str) -> dict[str, dict[str, np.ndarray]]:
    """Squared errors (trials, steps) by group of components and filter."""
    groups = plugins.study(study).judged_components
    found: dict[str, dict[str, np.ndarray]] = {name: {} for name in groups}
    for filter_ in results.filters(study, point):
        error = results.runs(study, point, filter_).error
        for name, components in groups.items():
            found[name][filter_] = sum(
                (error[..., i] ** 2 for i in components), np.zeros(error.shape[:2])
            )
    return found


def _bounds(results: Results, study: str, point: str) -> Iterator[tuple[str, str, np.ndarray]]:
    """Component, kind of bound, and bounds of its squared error, (trials, steps)."""
    scenario = plugins.study(study)
    information = scenario.information(results.log(study, point))
    if information is not None:
        for name, bound in cramer_rao(scenario, information).items():
            yield name, KNOWN, bound
    for filter_, kind in scenario.best_filters.items():
        if filter_ in results.filters(study, point):
            recorded = results.runs(study, point, filter_).recorded
            for name in scenario.judged_components:
                yield name, kind, recorded[claimed(name)]


def cramer_rao(scenario: Study, information: Information) -> dict[str, np.ndarray]:
    """Bounds of the squared error of each judged group, (trials, steps)."""
    n, judged = len(information.transition), scenario.judged_components
    groups = np.zeros((len(judged), n))
    for of, components in zip(groups, judged.values(), strict=True):
        of[list(components)] = 1.0
    trials, steps, _ = information.arrived.shape
    found = np.empty((trials, steps, len(judged)))
    kernels.cramer_rao(
        information.transition,
        information.noise,
        information.start,
        information.informations,
        np.ascontiguousarray(information.arrived),
        information.first,
        groups,
        found,
        np.empty((4, n, n)),
    )
    return {name: found[..., g] for g, name in enumerate(judged)}


def _compared(
    where: dict[str, Any], least: np.ndarray, squared: np.ndarray
) -> tuple[dict[str, Any], pd.DataFrame]:
    """A filter beside a bound: over all k, and over k."""
    bound, error = (np.ascontiguousarray(of[:, 1:].T) for of in (least, squared))
    roots, mcse = {}, {}
    for name, of in (("least", bound), ("error", error)):
        left_out = metrics.leave_one_out(of.T, np.sqrt)
        roots[name] = np.sqrt(of.mean(axis=1))
        mcse[name] = metrics.jackknife_error(left_out)
        where[name] = float(roots[name].mean())
        where[f"{name}_mcse"] = float(metrics.jackknife_error(left_out.mean(axis=1)))
    steps = len(bound)
    k = np.unique(np.linspace(1, steps, min(steps, SHOWN_STEPS)).round().astype(int))
    of_steps = {"k": k, "least": roots["least"][k - 1], "least_mcse": mcse["least"][k - 1]}
    of_steps |= {"error": roots["error"][k - 1], "error_mcse": mcse["error"][k - 1]}
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = of_steps["error"] / of_steps["least"]
    curve = pd.DataFrame(where | of_steps | {"ratio": ratio}, columns=list(COLUMNS))
    ratio = where["error"] / where["least"] if where["least"] > 0 else np.nan
    return where | {"k": np.nan, "ratio": ratio}, curve
