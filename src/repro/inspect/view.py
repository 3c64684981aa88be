"""One trial in detail: truth, signals, and every filter's estimate and error on one clock."""

import itertools
import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from repro import plugins
from repro.atomic import atomic_write
from repro.errors import ReproError
from repro.logs import Log, write_log
from repro.runner import flown, run
from repro.studies import ClosedLoop

LAYOUT = "foxglove-layout.json"  # the layout as an attachment of the view
STATES = 4  # that have a panel
SIGNALS = 12  # lines in the panel of signals, about; at least one of each topic


Settings = Mapping[str, dict[str, Any]]  # of each filter


def trial_view(log: Log, filters: Settings, trial: int) -> Log:
    """The log of one trial with the topics /estimate/<filter> and /error/<filter> added.

    Both have the fields of /truth. In a closed loop each filter has its own truth, and the topics
    of its flight end in its name. The filters run here once more, on this trial alone, for a run
    depends on no other. Raises ReproError if the point has no such trial.
    """
    if trial not in log.trials:
        last = log.trials[-1]
        raise ReproError(f"trial {trial}: {log.study}, {log.point} has the trials 0 to {last}")
    at = int(np.flatnonzero(log.trials == trial)[0])
    alone = log._replace(
        trials=log.trials[at : at + 1],
        values={topic: values[at : at + 1] for topic, values in log.values.items()},
    )
    add = _add_flight if isinstance(plugins.study(log.study), ClosedLoop) else _add_estimate
    view = alone
    for name, settings in filters.items():
        view = add(view, alone, name, settings)
    return view


def _with(view: Log, fields: tuple[str, ...], topics: dict[str, np.ndarray]) -> Log:
    return view._replace(
        fields=view.fields | dict.fromkeys(topics, fields), values=view.values | topics
    )


def _add_estimate(view: Log, log: Log, name: str, settings: dict[str, Any]) -> Log:
    estimate, runs = run(log, name, settings)
    topics = {f"/estimate/{name}": estimate, f"/error/{name}": runs.error}
    return _with(view, view.fields["/truth"], topics)


def _add_flight(view: Log, log: Log, name: str, settings: dict[str, Any]) -> Log:
    flight = flown(log, name, settings)
    for topic, values in flight.values.items():
        shown = topic if topic == "/reference" else f"{topic}/{name}"
        view = _with(view, flight.fields[topic], {shown: values})
    error = flight.values["/estimate"] - flight.values["/truth"]
    return _with(view, flight.fields["/truth"], {f"/error/{name}": error})


def write_view(
    log: Log, filters: Settings, trial: int, path: str | Path, layout: str | Path
) -> None:
    """Write the view and its Foxglove layout, which the view also carries as an attachment."""
    view = trial_view(log, filters, trial)
    scenario = plugins.study(view.study)
    drawn = json.dumps(foxglove_layout(view, scenario.trajectory), indent=1)
    with atomic_write(layout) as part:
        part.write_text(drawn + "\n", encoding="utf-8")
    write_log(path, view, scenario.period(view.parameters), {LAYOUT: drawn.encode()})


def foxglove_layout(view: Log, trajectory: tuple[tuple[str, str], ...]) -> dict[str, Any]:
    """Panels: trajectories (the first pair of fields), states, signals and errors over time.

    In a closed loop the trajectories and states are those that were flown.
    """
    truths, estimates = _of_kind(view, "truth"), _of_kind(view, "estimate")
    sources = [*truths, *(estimates if truths == ["/truth"] else ()), *_of_kind(view, "reference")]
    errors = _of_kind(view, "error")
    panels = {}
    for x, y in trajectory[:1]:
        for source in sources:
            panels[f"Plot!{source.strip('/').replace('/', '_')}_{x}_{y}"] = _plot(
                f"{source}: {y} over {x}", {source: f"{source}.{y}"}, f"{source}.{x}"
            )
    states = list(dict.fromkeys([*itertools.chain(*trajectory), *view.fields[truths[0]]]))
    for state in states[:STATES]:
        drawn = {s: f"{s}.{state}" for s in sources if state in view.fields[s]}
        panels[f"Plot!state_{state}"] = _plot(state, drawn)
    topics = _of_kind(view, "received", "network", "throttle")
    each = max(1, SIGNALS // max(1, len(topics)))
    signals = {f"{t}.{field}": f"{t}.{field}" for t in topics for field in view.fields[t][:each]}
    panels["Plot!signals"] = _plot("received and network", signals)
    for state in states[:2]:
        panels[f"Plot!error_{state}"] = _plot(
            f"error of {state}", {e.removeprefix("/error/"): f"{e}.{state}" for e in errors}
        )
    return {
        "configById": panels,
        "globalVariables": {},
        "userNodes": {},
        "playbackConfig": {"speed": 1},
        "layout": _split(list(panels), "row"),
    }


def _of_kind(view: Log, *kinds: str) -> list[str]:
    """Topics /kind and /kind/<filter>."""
    return [topic for topic in view.fields if topic.split("/")[1] in kinds]


def _plot(title: str, series: dict[str, str], over: str | None = None) -> dict[str, Any]:
    config = {
        "foxglovePanelTitle": title,
        "paths": [
            {"value": path, "label": label, "enabled": True, "timestampMethod": "receiveTime"}
            for label, path in series.items()
        ],
        "showLegend": True,
        "legendDisplay": "floating",
        "showXAxisLabels": True,
        "showYAxisLabels": True,
        "isSynced": over is None,
        "xAxisVal": "timestamp" if over is None else "custom",
    }
    return (
        config
        if over is None
        else config
        | {"xAxisPath": {"value": over, "enabled": True, "timestampMethod": "receiveTime"}}
    )


def _split(names: list[str], direction: str) -> dict[str, Any] | str:
    """A mosaic that halves the panels in turn."""
    if len(names) == 1:
        return names[0]
    half, other = len(names) // 2, {"row": "column", "column": "row"}[direction]
    first, second = (_split(part, other) for part in (names[:half], names[half:]))
    return {"direction": direction, "first": first, "second": second, "splitPercentage": 50}
