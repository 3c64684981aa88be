"""How the estimates of censored_network approach their limit as particles are added [Remark 4]."""

import numpy as np

from repro.studies.families.censored_network import squared_distance
from repro.tables.convergence import Convergence
from repro.tables.results import Results

FILTERS = ("mapf", "mpf")  # of one limit, since both have the full likelihood
REFERENCE = "mpf"  # with the most particles it stands for the limit
SWEPT = "particles"


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
