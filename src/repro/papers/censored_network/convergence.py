"""How the estimates of censored_network approach their limit as particles are added [Remark 4]."""

from typing import NamedTuple

import numpy as np

from repro.statistics import metrics
from repro.studies.families.censored_network import squared_distance
from repro.tables.results import Results

FILTERS = ("mapf", "mpf")  # of one limit, since both have the full likelihood
REFERENCE = "mpf"  # with the most particles it stands for the limit
SWEPT = "particles"


class Convergence(NamedTuple):
    """Squared distance of estimated positions from the reference, mean of steps and targets."""

    particles: np.ndarray  # (sizes,), rising
    of_reference: int  # its particles
    squared: np.ndarray  # m^2, (trials, sizes)

    def rate(self) -> tuple[float, float]:
        """Exponent r of a mean square distance like D^-r, and its jackknife standard error.

        The reference has an error of its own, of the same law: the abscissa is 1/D + 1/D_reference.
        """
        abscissa = np.log(1.0 / self.particles + 1.0 / self.of_reference)
        centred = abscissa - abscissa.mean()

        def slope(mean_squared: np.ndarray) -> np.ndarray:
            return np.log(mean_squared) @ centred / (centred @ centred)

        left_out = metrics.leave_one_out(self.squared, slope)
        return float(slope(self.squared.mean(axis=0))), float(metrics.jackknife_error(left_out))


def convergence(results: Results, study: str, filter_: str) -> Convergence:
    """From the points that sweep the number of particles, whose trials have the same truth.

    Raises LookupError where they do not run.
    """
    sizes = _sizes(results, study)
    *few, most = sorted(sizes)
    reference = results.runs(study, sizes[most], REFERENCE)
    squared = []
    for size in few:
        runs = results.runs(study, sizes[size], filter_)
        distance = runs._replace(error=runs.error - reference.error)  # the truth cancels
        squared.append(squared_distance(distance)[:, 1:].mean(axis=(1, 2)))
    return Convergence(np.array(few), most, np.stack(squared, axis=1))


def _sizes(results: Results, study: str) -> dict[int, str]:
    """Points by number of particles."""
    sizes = {
        value: name
        for name, point in results.points(study).items()
        if name.startswith(f"{SWEPT}=")
        for value in point["swept"].values()
    }
    if not sizes:
        raise LookupError(f"{study}: no point sweeps the number of particles")
    return sizes
