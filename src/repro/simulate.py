"""Ground truth and impaired measurements of one shard of trials -> one log."""

from pathlib import Path

import numpy as np

from repro.errors import computing
from repro.logs import Log, write_log
from repro.streams import Streams
from repro.studies import study_module


def simulated(study: str, point: str, parameters: dict, seed: int, trials: np.ndarray) -> Log:
    """The log of the given trials in memory."""
    module = study_module(study)
    return Log(
        study=study,
        point=point,
        seed=seed,
        parameters=parameters,
        trials=trials,
        fields=module.topics(parameters),
        values=module.simulate(
            parameters, lambda role: Streams(seed, study, role, trials.tolist())
        ),
    )


def simulate(
    study: str, point: str, parameters: dict, seed: int, trials: tuple[int, int], path: str | Path
) -> None:
    """Write the log of trials first ... last - 1."""
    with computing(f"{study}, {point}"):
        log = simulated(study, point, parameters, seed, np.arange(*trials))
        write_log(path, log, study_module(study).period(parameters))
