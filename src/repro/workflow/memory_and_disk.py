"""What a run will take of memory and disk, estimated before it starts, against what is free.

The factors were measured on all studies; most jobs are within a third of the estimate.
"""

import shutil
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import NamedTuple

from repro import plugins
from repro.errors import ReproError
from repro.layout import Layout
from repro.parameters.load import Point
from repro.parameters.point_names import batch_of
from repro.parameters.values import PointParameters

MB, GB = 1e6, 1e9
MESSAGE = 51  # bytes of a message besides its values, its index entry included
COMPRESSED = 0.5  # of a log
KEPT = 1.4  # numbers in the file of runs, for each component of the error that it keeps
JOB = 100 * MB  # of a process that has imported what it needs
HELD = 1.6  # bytes in the memory of a job, for each byte of its log before compression


class Needs(NamedTuple):
    """Estimates in bytes."""

    disk: float
    memory: float  # of the largest job
    jobs: int  # that run at once


class Free(NamedTuple):
    """What there is, in bytes."""

    disk: float
    memory: float


def estimated_needs(
    outputs: Iterable[str],
    layout: Layout,
    studies: Mapping[str, Mapping[str, Point]],
    shards: int,
    at_once: int,
) -> Needs:
    """What the jobs with these outputs take, of which so many run at once.

    Only logs and runs count. What they replace is free again.
    """
    disk, memory, jobs = 0.0, 0.0, 0
    for output in outputs:
        file = Path(output)
        if not file.is_relative_to(layout.root):
            continue
        kind, *place = file.relative_to(layout.root).parts
        if kind not in ("logs", "runs") or place[0] not in studies:
            continue
        points = studies[place[0]]
        of_file = [points[p] for p in points if place[1] in (p, batch_of(p))]
        sizes = [_sizes(place[0], point.parameters, shards) for point in of_file]
        disk += sum(size[kind] for size in sizes)
        disk -= file.stat().st_size if file.exists() else 0
        memory = max(memory, *(JOB + HELD * size["messages"] for size in sizes))
        jobs += 1
    return Needs(max(disk, 0.0), memory, min(jobs, at_once))


def _sizes(study: str, parameters: PointParameters, shards: int) -> dict[str, float]:
    """Bytes of the files of a shard of a point, and of the messages of its log."""
    scenario = plugins.study(study)
    topics = scenario.topics(parameters)
    rows = -(-parameters.trials // shards) * (parameters.steps + 1)
    messages, stored = (
        rows * sum(MESSAGE + 8 * len(of[t]) for t in of if t not in scenario.constant_topics)
        for of in (topics, scenario.stored(parameters))
    )
    states = len(topics.get("/truth") or scenario.model(parameters).initial_mean)
    kept = len(scenario.kept_components or range(states))
    return {
        "messages": messages,
        "logs": COMPRESSED * stored,
        "runs": 4 * KEPT * rows * kept,
    }


def check_memory(study: str, point: str, parameters: PointParameters) -> None:
    """Raise ReproError if all trials of a point do not fit into the memory of one process."""
    memory = JOB + HELD * _sizes(study, parameters, 1)["messages"]
    there = min(_available(), _of_group())
    if memory > there:
        raise ReproError(
            f"{study}, {point}: {parameters.trials} trials of {parameters.steps} steps take about "
            f"{_shown(memory)} of memory and {_shown(there)} are free: take fewer trials"
        )


def free(folder: str | Path) -> Free:
    """What is free on the disk of a folder, which need not exist yet, and in memory."""
    there = Path(folder).absolute()
    while not there.exists():
        there = there.parent
    return Free(shutil.disk_usage(there).free, min(_available(), _of_group()))


def _available() -> float:
    """Memory that the machine can give without swapping; unbounded where it does not say."""
    told = Path("/proc/meminfo")
    if told.exists():
        for line in told.read_text(encoding="utf-8").splitlines():
            name, value, *_ = line.split()
            if name == "MemAvailable:":
                return 1024 * float(value)
    return float("inf")


def _of_group(folder: str = "/sys/fs/cgroup") -> float:
    """Memory that is left to the container, if this is one with a bound."""
    try:
        limit, used = (
            Path(folder, f"memory.{name}").read_text(encoding="utf-8")
            for name in ("max", "current")
        )
        return float(limit) - float(used)
    except (OSError, ValueError):  # none, or "max"
        return float("inf")


def check_needs(needed: Needs, there: Free, folder: str | Path, *, local: bool = True) -> str:
    """A line for the start of a run. Raises ReproError if disk or memory do not suffice.

    Jobs that are not `local` have their memory elsewhere.
    """
    memory = needed.jobs * needed.memory
    if needed.disk > there.disk:
        raise ReproError(
            f"{folder}: the results take about {_shown(needed.disk)} on disk and "
            f"{_shown(there.disk)} are free: take fewer trials, name the tables that you need, or "
            "write elsewhere with --config into=FOLDER"
        )
    if local and memory > there.memory:
        raise ReproError(
            f"{needed.jobs} jobs at once take about {_shown(memory)} of memory and "
            f"{_shown(there.memory)} are free: run fewer at once (-j1), take fewer trials, or "
            "split them with --config shards=N"
        )
    line = f"About {_shown(needed.disk)} on disk ({_shown(there.disk)} free)"
    if not local:
        return f"{line}, {_shown(needed.memory)} of memory a job."
    return f"{line}, {_shown(memory)} of memory ({_shown(there.memory)} free)."


def _shown(size: float) -> str:
    return f"{size / GB:.1f} GB" if size >= 0.1 * GB else f"{size / MB:.0f} MB"
