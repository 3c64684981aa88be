"""The studies: one file each, which joins a model, a network, a log and the paper's metrics.

A study module gives
    topics(parameters)              fields of each topic of its logs
    period(parameters)              seconds of log clock a step
    simulate(parameters, streams)   values of each topic; streams(role) gives that role's streams
    model(parameters)               what a filter knows of system and network
    channels(log, trials, parameters)   what a filter may see of a slice of trials
    error(log, estimate)            error of every state component, (trials, steps, n)
    rows(shards), curves(shards)    (metric, component, Statistic) for the tables and over k
    lost(runs)                      which runs have lost what they track, or None
and if it likes
    first_step(parameters)          0 if y(0) is used, without a prediction before it; else 1
    TRIALS_A_BLOCK                  how many systems the runner puts side by side
    CLAIMED_VARIANCE                False: the variances that the filters claim are not kept
    INFERRED_ARRIVALS               True: what the filters infer of the arrivals is kept
    TRAJECTORY                      pairs of fields of /truth that a view draws over one another
    flight(log, estimate, runs)     of a closed loop: the log of what was flown
"""

from importlib import import_module
from types import ModuleType

from repro.errors import ReproError


def open_loop_module(name: str) -> ModuleType:
    """The module of a study whose logs have a truth; raises ReproError for a closed loop."""
    module = study_module(name)
    if hasattr(module, "flight"):
        raise ReproError(
            f"{name}: a closed loop, in which every filter has its own truth; its logs hold the "
            "disturbances, and results/flights/ what each filter flew"
        )
    return module


def study_module(name: str) -> ModuleType:
    """The module of a study by its name."""
    return import_module(f"repro.studies.{name}")
