"""A filter on a log recorded elsewhere: estimates, and errors where the log has the truth."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from repro import plugins
from repro.errors import ReproError
from repro.logs import Log, LogError
from repro.logs.user_log import read_user_log
from repro.network.channels import ALWAYS_SEEN
from repro.runner import run
from repro.studies import ClosedLoop, Fields, Study
from repro.tables.csv_file import write_csv


def run_user_log(
    log_path: str | Path, user_log: Mapping[str, Any], name: str, path: str | Path
) -> None:
    """Write trial, k, the estimate of every state component and, if the log has /truth, its error.

    `user_log` has `study`, `point`, the point's `parameters` and the filter's `settings`; it may
    have `changes` of the parameters, with the place that they are from, and the root `seed` of
    the filter's draws. Raises ReproError if the log or the filter does not fit the study.
    """
    study, point = user_log["study"], user_log["point"]
    scenario = open_loop(study)
    changes, place = user_log.get("changes", ({}, ""))
    where = place if changes else f"{study}: parameters"
    parameters = scenario.Parameters.checked(user_log["parameters"] | changes, where)
    topics = scenario.topics(parameters)
    fields, reasons = _needed(scenario, study, name, parameters)
    log = read_user_log(
        log_path,
        fields,
        study,
        point,
        parameters,
        once=scenario.constant_topics,
        reasons=reasons,
        seed=user_log.get("seed", 0),
        changed=changes,
    )
    _check(log_path, log, scenario)
    log = _with_all_topics(log, topics, scenario.constant_topics)
    # Integers made of what the filter does not see; huge numbers, whose estimates are checked.
    with np.errstate(invalid="ignore", over="ignore"):
        estimate, runs = run(log, name, user_log["settings"])
    trials, steps, n = estimate.shape
    states = topics["/truth"]
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


def _needed(
    scenario: Study, study: str, name: str, parameters: Any
) -> tuple[Fields, dict[str, str]]:
    """Fields of the topics that a filter's channels are made of, and what each topic is needed for.

    /truth is among the fields in any case. Raises ReproError for a channel that there is not.
    """
    topics, of_channels = scenario.topics(parameters), scenario.channel_topics(parameters)
    if of_channels is None:
        return topics, {}
    sees = plugins.filter_module(name).SEES
    for channel in sees:
        if channel not in of_channels:
            known = ", ".join(c for c in of_channels if c not in ALWAYS_SEEN)
            raise ReproError(
                f"filter {name}: SEES names the channel '{channel}', which {study} does not have; "
                f"it has {known}"
            )
    # A filter without a channel gets its number of steps from what it could receive.
    channels = [*(sees or ("received",)), *(c for c in ALWAYS_SEEN if c in of_channels)]
    remark = f": {scenario.log_remark}" if scenario.log_remark else ""
    wanted: dict[str, set[str]] = {"/truth": set(topics["/truth"])}
    reasons: dict[str, str] = {}
    for channel in channels:
        for topic, names in of_channels.get(channel, {}).items():
            wanted.setdefault(topic, set()).update(names)
            reasons.setdefault(
                topic, f"; filter {name} needs it for its channel '{channel}'{remark}"
            )
    fields = {
        topic: tuple(n for n in names if n in wanted[topic])
        for topic, names in topics.items()
        if topic in wanted
    }
    return fields, reasons


def _check(path: str | Path, log: Log, scenario: Study) -> None:
    """Raise LogError for more steps than the parameters have, and for impossible integers."""
    most = log.parameters.steps + 1  # 0 ... steps
    if log.steps > most:
        raise LogError(
            f"{path}: a trial has {log.steps} messages; the parameters have steps = "
            f"{log.parameters.steps}: give steps={log.steps - 1} with --config parameters=FILE"
        )
    for topic, bounds in scenario.integers(log.parameters).items():
        for name, (least, greatest) in bounds.items():
            if name in log.fields.get(topic, ()):
                values = log.field(topic, name)
                wrong = (values < least) | (values > greatest) | (values % 1 != 0)
                if wrong.any():
                    trial, step = np.argwhere(wrong)[0]
                    raise LogError(
                        f"{path}: topic {topic}: the field '{name}' of trial {log.trials[trial]}, "
                        f"step {step} is {values[trial, step]:g}; it must be an integer from "
                        f"{least} to {greatest}"
                    )

    fault = scenario.fault(log)
    if fault is not None:
        raise LogError(f"{path}: {fault}")


def _with_all_topics(log: Log, topics: Fields, once: tuple[str, ...]) -> Log:
    """The log with NaN for the topics and fields that were not read, except for a missing truth."""
    values = {}
    for topic, names in topics.items():
        read = log.fields.get(topic, ())
        if read or topic != "/truth":
            steps = 1 if topic in once else log.steps
            values[topic] = np.full((len(log.trials), steps, len(names)), np.nan)
            at = [names.index(name) for name in read]
            values[topic][:, :, at] = log.values[topic] if read else np.nan
    return log._replace(fields={t: topics[t] for t in values}, values=values)
