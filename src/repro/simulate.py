"""Ground truth and impaired measurements of one shard of trials -> one log."""

from pathlib import Path
from typing import Any

import numpy as np

from repro import plugins
from repro.errors import computing
from repro.logs import Log, selected, write_log
from repro.parameters.values import PointParameters
from repro.streams import Streams


def simulated(
    study: str, point: str, parameters: PointParameters, seed: int, trials: np.ndarray
) -> Log:
    """The log of the given trials in memory."""
    scenario = plugins.study(study)
    return Log(
        study=study,
        point=point,
        seed=seed,
        parameters=parameters,
        trials=trials,
        fields=scenario.topics(parameters),
        values=scenario.simulate(
            parameters, lambda role: Streams(seed, study, role, trials.tolist())
        ),
    )


def simulate(
    study: str,
    point: str,
    parameters: dict[str, Any],
    seed: int,
    trials: tuple[int, int],
    path: str | Path,
    origin: str = "",
) -> None:
    """Write the log of trials first ... last - 1; `origin` is what its readers ask for."""
    scenario = plugins.study(study)
    typed = scenario.Parameters.checked(parameters, f"{study}, {point}: parameters")
    with computing(f"{study}, {point}"):
        log = simulated(study, point, typed, seed, np.arange(*trials))
        for topic, values in log.values.items():
            if not np.isfinite(values).all():
                raise ArithmeticError(f"a number of {topic} is not finite")
        write_log(
            path, selected(log, scenario.stored(typed)), scenario.period(typed), origin=origin
        )
