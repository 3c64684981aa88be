"""Filters on one problem, timed in turn: what kernels.py and the benchmarks that it joins share."""

import os
import platform
import sys
from collections.abc import Callable
from pathlib import Path
from statistics import median
from time import process_time
from typing import Any, NamedTuple

import numpy as np
from tabulate import tabulate

from repro import plugins
from repro.logs import Log
from repro.network.channels import Seen
from repro.parameters.load import load_paper
from repro.parameters.settings import typed_settings
from repro.runner import build
from repro.runner.faults import Task
from repro.simulate import simulated
from repro.statistics.runs import Runs
from repro.streams import Streams

ROOT = Path(__file__).parent.parent
REPETITIONS, OF_SHORT, SHORT = 5, 3, 10  # --short: fewer, with so many times fewer trials


class Timed(NamedTuple):
    """One run of a filter."""

    start: float  # CPU s of what comes before the first step, 0 if not told apart
    steps: float  # CPU s of the rest
    estimate: np.ndarray  # (trials, steps, n) from the first estimated step on


class Contender(NamedTuple):
    """A filter of the project or of a peer on the first trials of a log."""

    name: str
    run: Callable[[], Timed]
    trials: int
    each: int = 1  # particles, or particles times nodes
    goal: float | None = None  # ns
    is_peer: bool = False  # a peer solves the problem of the first filter of its table


class Problem(NamedTuple):
    """A point of a study, with the settings of its filters."""

    log: Log
    settings: dict[str, dict[str, Any]]


def problem(paper: str, study: str, point: str, trials: int) -> Problem:
    """Some trials of a point, simulated."""
    found = load_paper(ROOT / "params" / f"{paper}.yaml").studies[study][point]
    log = simulated(study, point, found.parameters, 1, np.arange(trials))
    return Problem(log, found.filters)


def of_project(given: Problem, name: str) -> Callable[[], Timed]:
    """A filter of the project as the runner builds and calls it, without the runner's checks."""
    log, (_, module) = given.log, plugins.named_filter(name)
    study = plugins.study(log.study)
    model, task = study.model(log.parameters), Task(name, f"{log.study}, {log.point}")
    settings = typed_settings(module, name, given.settings.get(name, {}), str(task))
    built = build(task, module, model, settings)
    size = max(1, study.systems_per_block // built.particles)
    first_step = study.first_step(log.parameters)
    nothing = np.zeros((size, len(model.initial_mean)))
    blocks = []
    for first in range(0, len(log.trials), size):
        channels = study.channels(log, slice(first, first + size))
        seen = [
            Seen(name, module.SEES, channels.at(k, nothing)) for k in range(first_step, log.steps)
        ]
        blocks.append((log.trials[first : first + size].tolist(), seen))

    def run() -> Timed:
        start = steps = 0.0
        estimates = []
        for trials, seen in blocks:
            begun = process_time()
            stream = Streams(log.seed, log.study, plugins.stream_of(name, module), trials)
            state = built.init(stream)
            started = process_time()
            means = []
            for k, channels in enumerate(seen, first_step):
                state = built.step(state, k, channels)
                means.append(built.mean(state))
            ended = process_time()
            start, steps = start + started - begun, steps + ended - started
            estimates.append(np.stack(means, axis=1))
        return Timed(start, steps, np.concatenate(estimates))

    return run


def of_peer(filtered: Callable[[], np.ndarray]) -> Callable[[], Timed]:
    """A function that returns its estimates, timed as a whole."""

    def run() -> Timed:
        begun = process_time()
        estimate = filtered()
        return Timed(0.0, process_time() - begun, estimate)

    return run


def squared_errors(log: Log, estimate: np.ndarray) -> np.ndarray:
    """Mean over the steps of the error by which the study ranks, (trials,)."""
    study, trials = plugins.study(log.study), len(estimate)
    first = log._replace(
        trials=log.trials[:trials], values={t: v[:trials] for t, v in log.values.items()}
    )
    missing = log.steps - estimate.shape[1]
    whole = np.concatenate([np.zeros_like(estimate[:, :missing]), estimate], axis=1)
    runs = Runs(study.error(first, whole), None, np.zeros(trials), {}, {})
    return study.squared_error(runs).mean(axis=1)


def compared(
    title: str, unit: str, log: Log, contenders: list[Contender], repetitions: int
) -> bool:
    """Print a table; whether every goal is reached.

    The first run of each warms it up and gives its error; then all are timed in turn. Goals are
    for the steps, without the start.
    """
    errors = [squared_errors(log, contender.run().estimate) for contender in contenders]
    times = np.array([[c.run()[:2] for c in contenders] for _ in range(repetitions)])
    steps = log.steps - plugins.study(log.study).first_step(log.parameters)
    times /= np.array([c.trials * c.each * steps for c in contenders])[:, None] / 1e9
    of_steps, wholes = times[..., 1], times.sum(axis=-1)
    rows, reached = [], True
    for i, contender in enumerate(contenders):
        took = median(of_steps[:, i])
        row = [contender.name, contender.trials, took, median(wholes[:, i]), contender.goal]
        row += [median(wholes[:, i] / each[:, 0]) for each in (of_steps, wholes)]
        beside = _beside(errors[i], errors[0]) if contender.is_peer else (None, None)
        rows.append([*row, np.sqrt(errors[i].mean()), *beside])
        reached &= contender.goal is None or took <= contender.goal
    first = contenders[0].name
    headers = ["filter", "trials", "ns, steps", "ns, with start", "goal"]
    headers += [f"times {first}'s steps", "with its start", "rms error", f"{first}'s", "z"]
    print(f"\n{title}: CPU ns per {unit}, medians of {repetitions} alternating repetitions")
    formats = ("", "d", ".1f", ".1f", "g", ".2f", ".2f", ".4g", ".4g", "")
    print(tabulate(rows, headers, tablefmt="github", floatfmt=formats), flush=True)
    return reached


def _beside(errors: np.ndarray, of_first: np.ndarray) -> tuple[float, str]:
    """The first's rms error on the same trials, and by how many standard errors they differ."""
    trials = min(len(errors), len(of_first))
    difference = errors[:trials] - of_first[:trials]
    of_same = float(np.sqrt(of_first[:trials].mean()))
    if np.abs(difference).max() <= 1e-6 * of_first[:trials].max():
        return of_same, "equal"
    return of_same, f"{difference.mean() / difference.std(ddof=1) * trials**0.5:+.1f}"


def introduce() -> None:
    """Print where this runs, and what the columns mean."""
    print(f"{processor()}. The start is what precedes the first step: random streams, prior; a")
    print("peer's time includes its own. Beside a peer's error stands that of the table's first")
    print("filter on the same trials; z: their mean squares' difference in standard errors.")


def sizes() -> tuple[int, int]:
    """Repetitions, and by how much the trials are divided, as the command line says."""
    return (OF_SHORT, SHORT) if "--short" in sys.argv[1:] else (REPETITIONS, 1)


def processor() -> str:
    """Model of the processor and number of cores."""
    lines = Path("/proc/cpuinfo")
    if not lines.exists():
        return platform.processor()
    name = next(line for line in lines.read_text().splitlines() if line.startswith("model name"))
    return f"{name.split(':')[1].strip()}, {os.cpu_count()} cores"
