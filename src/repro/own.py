"""A filter on a log recorded elsewhere: estimates, and errors where the log has the truth."""

from pathlib import Path

import numpy as np
import pandas as pd

from repro.errors import ReproError
from repro.logs import read_foreign
from repro.run import run
from repro.studies import open_loop_module
from repro.tables import write_csv


def run_own(log_path: str, asked: dict, name: str, path: str | Path) -> None:
    """Write trial, k, the estimate of every state component and, if known, its error.

    `asked` has `study`, `point`, the point's `parameters` and the filter's `settings`.
    """
    study, parameters = asked["study"], asked["parameters"]
    fields = open_loop_module(study).topics(parameters)
    log = read_foreign(log_path, fields, study, asked["point"], parameters)
    estimate, runs = run(log, name, asked["settings"])
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
