"""One trial to look into: truth, signals, and every filter's estimate and error on one clock."""

import json
from pathlib import Path

import numpy as np

from repro.errors import ReproError
from repro.logs import Log, write_log
from repro.results import Results
from repro.studies import open_loop_module, study_module
from repro.whole import whole

LAYOUT = "foxglove-layout.json"  # the layout as an attachment of the view


def trial_view(results: Results, study: str, point: str, trial: int) -> Log:
    """The log of one trial with the topics /estimate/<filter> and /error/<filter> added.

    Both have the fields of /truth. Raises ReproError if the point has no such trial.
    """
    open_loop_module(study)
    log = results.log(study, point)
    if trial not in log.trials:
        last = log.trials[-1]
        raise ReproError(f"trial {trial}: {study}, {point} has the trials 0 to {last}; name one")
    at = int(np.flatnonzero(log.trials == trial)[0])
    fields, values = dict(log.fields), {t: v[at : at + 1] for t, v in log.values.items()}
    for filter_ in results.filters(study, point):
        error = results.runs(study, point, filter_).error[at : at + 1]
        for topic, array in (("estimate", values["/truth"] + error), ("error", error)):
            fields[f"/{topic}/{filter_}"] = log.fields["/truth"]
            values[f"/{topic}/{filter_}"] = array
    return log._replace(trials=log.trials[at : at + 1], fields=fields, values=values)


def write_view(
    results: Results, study: str, point: str, trial: int, path: str | Path, layout: str | Path
) -> None:
    """Write the view and its Foxglove layout, which the view also carries as an attachment."""
    view = trial_view(results, study, point, trial)
    module = study_module(study)
    drawn = json.dumps(foxglove_layout(view, getattr(module, "TRAJECTORY", ())), indent=1)
    with whole(layout) as part:
        part.write_text(drawn + "\n")
    write_log(path, view, module.period(view.parameters), {LAYOUT: drawn.encode()})


def foxglove_layout(view: Log, trajectory: tuple[tuple[str, str], ...]) -> dict:
    """Panels: trajectories (pairs of fields of /truth), states, signals, and errors over time."""
    states = view.fields["/truth"]
    filters = [t.removeprefix("/estimate/") for t in view.fields if t.startswith("/estimate/")]
    sources = ["/truth", *(f"/estimate/{filter_}" for filter_ in filters)]
    panels = {}
    for x, y in trajectory:
        for source in sources:
            panels[f"Plot!{source.strip('/').replace('/', '_')}_{x}_{y}"] = _plot(
                f"{source}: {y} over {x}", {source: f"{source}.{y}"}, f"{source}.{x}"
            )
    for state in states[:6]:
        panels[f"Plot!state_{state}"] = _plot(state, {s: f"{s}.{state}" for s in sources})
    signals = {
        f"{topic}.{field}": f"{topic}.{field}"
        for topic in ("/received", "/network")
        for field in view.fields.get(topic, ())[:6]
    }
    panels["Plot!signals"] = _plot("received and network", signals)
    for state in states[:2]:
        panels[f"Plot!error_{state}"] = _plot(
            f"error of {state}", {f: f"/error/{f}.{state}" for f in filters}
        )
    return {
        "configById": panels,
        "globalVariables": {},
        "userNodes": {},
        "playbackConfig": {"speed": 1},
        "layout": _split(list(panels), "row"),
    }


def _plot(title: str, series: dict[str, str], over: str | None = None) -> dict:
    config = {
        "title": title,
        "paths": [
            {"value": path, "label": label, "enabled": True, "timestampMethod": "receiveTime"}
            for label, path in series.items()
        ],
        "showLegend": True,
        "isSynced": over is None,
        "xAxisVal": "timestamp" if over is None else "custom",
    }
    return config if over is None else config | {"xAxisPath": {"value": over, "enabled": True}}


def _split(names: list[str], direction: str) -> dict | str:
    """A mosaic that halves the panels in turn."""
    if len(names) == 1:
        return names[0]
    half, other = len(names) // 2, {"row": "column", "column": "row"}[direction]
    first, second = (_split(part, other) for part in (names[:half], names[half:]))
    return {"direction": direction, "first": first, "second": second, "splitPercentage": 50}
