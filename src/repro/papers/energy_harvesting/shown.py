"""The run that the figures of a single run show [energy_harvesting Figs. 2-5, 11]."""

from collections.abc import Sequence

import numpy as np

from repro.papers.energy_harvesting.compared import PROPOSED, study_of
from repro.statistics.runs import Runs
from repro.statistics.typical_run import TypicalRun, typical_run
from repro.studies.families import harvesting_sensors
from repro.tables.results import Results


def shown_run(results: Results, study: str, filters: Sequence[str] = (PROPOSED,)) -> TypicalRun:
    """The median run of the base point, by the mean square over k of position, or of the state."""
    first = next(iter(study_of(study).components.values()))

    def mean_square(runs: Runs) -> np.ndarray:
        return harvesting_sensors.squared(runs, first)[:, 1:].mean(axis=1)

    return typical_run([results.each(study, "base", name, mean_square) for name in filters])
