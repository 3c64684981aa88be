"""A filter on a log recorded elsewhere: estimates, and errors where the log has the truth."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from repro import plugins
from repro.errors import ReproError
from repro.logs.user_log import read_user_log
from repro.runner import run
from repro.studies import ClosedLoop, Study
from repro.tables.csv_file import write_csv


def run_user_log(
    log_path: str | Path, user_log: Mapping[str, Any], name: str, path: str | Path
) -> None:
    """Write trial, k, the estimate of every state component and, if the log has /truth, its error.

    `user_log` has `study`, `point`, the point's `parameters` and the filter's `settings`. Raises
    ReproError if the log or the filter does not fit the study.
    """
    study = user_log["study"]
    scenario = open_loop(study)
    parameters = scenario.Parameters.checked(user_log["parameters"], f"{study}: parameters")
    fields = scenario.topics(parameters)
    log = read_user_log(log_path, fields, study, user_log["point"], parameters)
    estimate, runs = run(log, name, user_log["settings"])
    trials, steps, n = estimate.shape
    states = fields["/truth"]
    if len(states) != n:
        raise ReproError(
            f"filter {name}: estimates {n} components; /truth of {study} has {len(states)}"
        )
    columns = {
        "trial": np.repeat(log.trials, steps),
        "k": np.tile(np.arange(steps), trials),
        **{state: estimate[:, :, i].ravel() for i, state in enumerate(states)},
    }
    if "/truth" in log.values:
        columns |= {f"error_{s}": runs.error[:, :, i].ravel() for i, s in enumerate(states)}
    write_csv(pd.DataFrame(columns), path)


def open_loop(name: str) -> Study:
    """The study of a name whose logs have a truth; raises ReproError for a closed loop."""
    scenario = plugins.study(name)
    if isinstance(scenario, ClosedLoop):
        raise ReproError(
            f"{name}: a closed loop, in which every filter has its own truth; its logs hold the "
            "disturbances, and results/flights/ what each filter flew"
        )
    return scenario
