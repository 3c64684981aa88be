"""What the searches found: how well geometries fit, what they predict, and profiles of the fit."""

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from repro.kernels import arrays
from repro.papers.censored_network.calibration import (
    Network,
    Printed,
    Row,
    misfit,
    with_average,
)
from repro.papers.censored_network.calibration_search import COMMITTED, Fit
from repro.statistics import metrics
from repro.statistics.paired import independent_error
from repro.studies.families.censored_network import COMPONENTS
from repro.tables.csv_file import write_csv


def tabulate_geometries(
    network: Network, printed: Printed, fits: Iterable[Fit], tolerance: float, path: str | Path
) -> None:
    """Write how well each geometry gives Tables I and II, the best first.

    All are judged on the same trials. `equal` says whether a misfit is within `tolerance`
    standard errors of its paired difference from the smallest.
    """
    committed = network.confirmed(network.committed, printed.rows)
    found = [({"fit": "committed", "left_out": ""}, network.committed, *committed)]
    for fit in fits:
        start = "committed" if fit.start == COMMITTED else f"screened {fit.start}"
        name: dict[str, Any] = {"fit": f"from {start}", "left_out": " ".join(fit.left_out or ())}
        name |= {"evaluations": network.search.evaluations}
        name |= dict(zip(("search_begun", "search_ended"), fit.searched, strict=True))
        found.append((name, network.box.geometry(fit.shares), fit.value, fit.jackknife))
    found.sort(key=lambda of: float(misfit(of[2], printed)))
    _, _, best, best_left_out = found[0]
    rows = []
    for name, geometry, value, left_out in found:
        worse = float(misfit(value, printed) - misfit(best, printed))
        paired = misfit(left_out, printed) - misfit(best_left_out, printed)
        error = float(metrics.jackknife_error(paired))
        rows.append(
            name
            | _measured(value, left_out, printed)
            | {"worse_than_best": worse, "mcse_of_difference": error}
            | {"equal": worse <= tolerance * error, "trials": len(left_out)}
            | geometry.columns()
        )
    write_csv(rows, path)


def tabulate_left_out(
    printed: Printed, fits: Sequence[Fit], tolerance: float, path: str | Path
) -> None:
    """Write what the fit to all other rows predicts of each row, beside what is printed.

    The prediction is that of the search with the smallest misfit on the rows that it saw. Its
    error has three parts: ours, of finitely many trials; that of the printed average, which has
    our spread at its number of trials; and the spread of the searches, by their start.
    """
    rows = []
    for row in printed.rows:
        rows += _predicted(row, [fit for fit in fits if fit.left_out == row], printed, tolerance)
    write_csv(rows, path)


def _predicted(
    row: Row, fits: list[Fit], printed: Printed, tolerance: float
) -> Iterator[dict[str, Any]]:
    """A row of the table for each target and for their average."""
    place, seen = printed.rows.index(row), printed.without(row)
    misfits = [float(misfit(np.delete(fit.value, place, axis=0), seen)) for fit in fits]
    best = fits[int(np.argmin(misfits))]
    theirs, ours = with_average(printed.values[place]), with_average(best.value[place])
    mcse = metrics.jackknife_error(with_average(best.jackknife[:, place]))
    of_starts = with_average(np.array([fit.value[place] for fit in fits]))
    spread = of_starts.std(axis=0, ddof=1) if len(fits) > 1 else np.full(len(ours), np.nan)
    their_error = mcse * np.sqrt(len(best.jackknife) / printed.trials)
    for i, component in enumerate(COMPONENTS):
        error = independent_error(mcse[i], their_error[i])
        error = independent_error(error, np.nan_to_num(spread[i]))
        z = float((ours[i] - theirs[i]) / error)
        yield {
            "study": row[0],
            "filter": row[1],
            "component": component,
            "printed": theirs[i],
            "predicted": ours[i],
            "mcse": mcse[i],
            "their_error": their_error[i],
            "spread": spread[i],
            "error": error,
            "z": z,
            "within": abs(z) <= tolerance,
            "starts": len(fits),
            "misfit_of_the_others": min(misfits),
        }


def tabulate_profile(network: Network, printed: Printed, path: str | Path) -> None:
    """Write the misfit over v, Omega and K, each with the others of the committed geometry."""
    search, committed, rows = network.search, network.committed, []
    for name, (lowest, highest) in (
        ("speed", search.speed_range),
        ("turn_rate", search.turn_rate_range),
        ("steps", search.steps_range),
    ):
        own = getattr(committed, name)
        over = np.linspace(lowest, highest, search.profile_values).tolist()
        for value in sorted({own, *(type(own)(round(value, 6)) for value in over)}):
            geometry = committed._replace(**{name: value})
            found = network.confirmed(geometry, printed.rows, search.particles)
            rows.append({"parameter": name, "value": float(value)} | _measured(*found, printed))
    write_csv(rows, path)


def _measured(value: np.ndarray, left_out: np.ndarray, printed: Printed) -> dict[str, float]:
    """Misfit, its standard error, and the misfit that our noise alone gives a perfect geometry."""
    noise = metrics.jackknife_error(arrays.log(left_out / printed.values))
    return {
        "misfit": float(misfit(value, printed)),
        "mcse": float(metrics.jackknife_error(misfit(left_out, printed))),
        "noise": float(np.sqrt((noise**2).mean())),
    }
