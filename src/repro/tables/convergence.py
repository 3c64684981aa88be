"""How the error of a particle filter falls with the number of its particles, and at what rate."""

import re
from collections.abc import Iterator, Mapping
from typing import Any, NamedTuple

import numpy as np

from repro import plugins
from repro.kernels import arrays
from repro.parameters.point_names import is_reading
from repro.statistics import metrics
from repro.tables.csv_file import write_csv
from repro.tables.results import Results
from repro.tables.study_tables import share_lost

SETTING = "particles"
FEWEST = 4  # counts besides the reference, for a rate with an error
# Over all counts, and over those from the printed one on.
RATES = ("rate", "rate_mcse", "rate_beyond", "rate_beyond_mcse")


class Convergence(NamedTuple):
    """Squared distance of the estimates from the reference, mean over the steps."""

    particles: np.ndarray  # (sizes,), rising
    of_reference: int  # its particles
    squared: np.ndarray  # (trials, sizes)

    def rate(self) -> tuple[float, float]:
        """Exponent r of a mean square distance like D^-r, and its jackknife standard error.

        The reference has an error of its own, of the same law: the abscissa is 1/D + 1/D_reference.
        """
        abscissa = arrays.log(1.0 / self.particles + 1.0 / self.of_reference)
        centred = abscissa - abscissa.mean()

        def slope(mean_squared: np.ndarray) -> np.ndarray:
            logs = arrays.log(mean_squared) * centred
            return logs.sum(axis=-1) / (centred * centred).sum()

        left_out = metrics.leave_one_out(self.squared, slope)
        return float(slope(self.squared.mean(axis=0))), float(metrics.jackknife_error(left_out))

    def beyond(self, count: int) -> "Convergence":
        """From so many particles on."""
        chosen = self.particles >= count
        return Convergence(self.particles[chosen], self.of_reference, self.squared[:, chosen])


def write_convergence(
    results: Results, study: str, printed: Mapping[str, int | None], path: str
) -> None:
    """Write error and distance to the reference of every count of particles of a study.

    `printed` are the particles that the paper gives each filter.
    """
    rows = []
    for (_, filter_), sizes in _sweeps(results, study).items():
        if len(sizes) > FEWEST:
            rows += _rows(results, study, filter_, sizes, printed.get(filter_))
    write_csv(rows, path)


def _sweeps(results: Results, study: str) -> dict[tuple[str, str], dict[int, str]]:
    """Points by number of particles, rising, that share a log: of each log and filter."""
    sweeps: dict[tuple[str, str], dict[int, str]] = {}
    for point, at in results.points(study).items():
        if is_reading(point):
            continue
        for key, value in at["swept"].items():
            for filter_, _, setting in (k.partition(".") for k in key.replace(" ", "").split(",")):
                if setting == SETTING and filter_ in results.filters(study, point):
                    log = results.log_of(study, point)
                    sweeps.setdefault((log, filter_), {})[value] = point
    return {key: dict(sorted(sizes.items())) for key, sizes in sweeps.items()}


def _rows(
    results: Results, study: str, filter_: str, sizes: Mapping[int, str], printed: int | None
) -> Iterator[dict[str, Any]]:
    scenario, analysis = plugins.study(study), results.analysis(study)
    most = max(sizes)
    reference = results.runs(study, sizes[most], filter_)
    best = results.rmse(study, sizes[most], filter_, scenario.squared_error, True)
    squared = {}
    for size, point in sizes.items():
        runs = results.runs(study, point, filter_)
        apart = runs._replace(error=runs.error - reference.error)  # the truth cancels
        squared[size] = scenario.squared_error(apart).mean(axis=1)
    few = [size for size in sizes if size != most]
    of_few = np.stack([squared[size] for size in few], axis=1)
    of_all = Convergence(np.array(few), most, of_few)
    beyond = of_all.beyond(printed or few[-1])
    rates = (*of_all.rate(), *(beyond.rate() if len(beyond.particles) > 1 else (np.nan, np.nan)))
    for size, point in sizes.items():
        error = results.rmse(study, point, filter_, scenario.squared_error, True)
        excess = error.left_out - best.left_out
        shards = results.in_shards(study, point, filter_)
        yield {
            "study": study,
            "where": where(point),
            "steps": reference.error.shape[1] - 1,
            "filter": filter_,
            "point": point,
            "particles": size,
            "printed": printed,
            "trials": shards.trials,
            "error": error.value,
            "mcse": float(metrics.jackknife_error(error.left_out)),
            "excess": error.value - best.value,
            "excess_mcse": float(metrics.jackknife_error(excess)),
            "squared_distance": float(squared[size].mean()),
            "squared_distance_mcse": float(metrics.mean_error(squared[size])),
            "lost": share_lost(scenario, analysis, shards),
            "reference": most,
        } | dict(zip(RATES, rates, strict=True))


def where(point: str) -> str:
    """What the name of a point says besides its particles."""
    return re.sub(rf"^convergence-|-?{SETTING}=[0-9]+-?", "", point) or "base"
