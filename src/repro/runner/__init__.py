"""Run one filter over one log, batched over trials."""

import time
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from repro import plugins
from repro.atomic import atomic_write
from repro.errors import ReproError, computing
from repro.filters import Filter
from repro.layout import Layout
from repro.logs import Log, read_log
from repro.origin import of_shard, origin
from repro.parameters.settings import (
    PlainSettings,
    assumed_parameters,
    own_settings,
    typed_settings,
)
from repro.runner.block import Block
from repro.runner.consistency import judged_claims
from repro.runner.faults import Inside, Progress, Task
from repro.statistics.runs import Runs, RunsWriter
from repro.streams import Streams
from repro.studies import ClosedLoop, Study


def run(
    log: Log, filter_: Any, settings: dict[str, Any], consistency: bool = False
) -> tuple[np.ndarray, Runs]:
    """Estimates (trials, steps, n) and runs of a filter on every trial of a log.

    `filter_` is a name, or whatever has LABEL, SEES and build. Settings `assumed_<parameter>` give
    it a model with other parameters than the log's. Without /truth in the log the errors are NaN.
    With `consistency` the runs keep whether the filter's covariance is true, if it has one: NEES of
    the groups of components that the study judges. Raises ReproError if the filter breaks its
    contract.
    """
    study, name, module = plugins.study(log.study), *plugins.named_filter(filter_)
    task = Task(name, f"{log.study}, {log.point}")
    with computing(f"{log.study}, {log.point}"):
        model = study.model(_as_assumed(log.parameters, assumed_parameters(settings), str(task)))
    typed = typed_settings(module, name, own_settings(settings), str(task))
    built = build(task, module, model, typed)
    size = max(1, study.systems_per_block // built.particles)
    progress = Progress(task, len(log.trials))
    blocks = []
    for first in range(0, len(log.trials), size):
        trials = slice(first, first + size)
        numbers = log.trials[trials]
        # Filters that share a stream draw the same numbers.
        stream = plugins.stream_of(name, module)
        block = Block(
            task,
            built,
            module.SEES,
            study.channels(log, trials),
            Streams(log.seed, log.study, stream, numbers.tolist()),
            numbers,
            steps=log.steps,
            states=len(model.initial_mean),
            first_step=study.first_step(log.parameters),
            kept=_kept(study),
            judged=study.judged_components if consistency else None,
        )
        blocks.append(block.run(progress))
        if isinstance(typed, PlainSettings):
            typed.check_all_read()
    estimate = _joined([block.estimate for block in blocks])
    flown = {t: _joined([block.flown[t] for block in blocks]) for t in blocks[0].flown}
    log = log._replace(values=log.values | flown)  # a closed loop decides its own truth
    error = study.error(log, estimate) if "/truth" in log.values else np.full_like(estimate, np.nan)
    of_blocks = {
        group: _joined([block.covariances[group] for block in blocks])
        for group in blocks[0].covariances
    }
    claims = judged_claims(error, study.judged_components, of_blocks)
    return estimate, Runs(
        error=error,
        claimed=_claimed([block.claimed for block in blocks]),
        degenerate=np.concatenate([block.degenerate for block in blocks]),
        recorded={
            key: _joined([block.recorded[key] for block in blocks]) for key in blocks[0].recorded
        }
        | claims,
        flown=flown,
    )


def _as_assumed(parameters: Any, assumed: dict[str, Any], where: str) -> Any:
    """The parameters that the filter takes the point's for: the log is made with the true ones."""
    if not assumed:
        return parameters
    return type(parameters).checked(parameters.plain() | assumed, f"{where}: assumed values")


def build(task: Task, module: Any, model: Any, settings: Any) -> Filter:
    """The filter for a model, with settings as `typed_settings` gives them.

    Raises ReproError if the model is not of the kind that the filter needs.
    """
    wanted = getattr(module.build, "__annotations__", {}).get("model")
    if isinstance(wanted, type) and not isinstance(model, wanted):
        raise ReproError(
            f"{task}: it needs a {wanted.__name__}; this study has a {type(model).__name__}"
        )
    with Inside(task, "build(model, settings)"):
        built = module.build(model, settings)
    if not isinstance(built, Filter):
        raise ReproError(f"{task}: build returned a {type(built).__name__}; it must be a Filter")
    return built


def _kept(study: Study) -> tuple[str, ...]:
    """What is kept of each step besides the estimate."""
    wanted = {"variance": study.keeps_claimed_variance, "arrived": study.keeps_inferred_arrivals}
    return tuple(name for name, is_wanted in wanted.items() if is_wanted)


def _claimed(of_blocks: list[np.ndarray | None]) -> np.ndarray | None:
    """Claimed variances of all blocks; (steps, n) if they are the same in every trial."""
    first, *_ = of_blocks
    if first is None or first.ndim == 2:
        return first
    return _joined([part for part in of_blocks if part is not None])


def _joined(of_blocks: list[np.ndarray]) -> np.ndarray:
    """Values of all blocks, (trials, ...), one trial after another in memory as in a log.

    The order in memory is that in which later sums are formed, and so concerns their bits.
    """
    trials = sum(len(part) for part in of_blocks)
    first = of_blocks[0]
    kind = np.result_type(*of_blocks)
    return np.concatenate(of_blocks, out=np.empty((trials, *first.shape[1:]), dtype=kind))


class FilteredPoint(NamedTuple):
    """What a job needs of a point to run a filter on it."""

    log: str  # its file
    settings: dict[str, Any]
    log_origin: str | None = None  # what the log must come from; None: anything
    origin: str = ""  # what the runs come from
    log_of: str | None = None  # the point whose log it is; None: its own
    consistency: bool = False  # whether the runs keep if the filter's covariance is true


def in_shard(
    study: str, shard: int, root: str, shards: int, points: Mapping[str, Mapping[str, Any]]
) -> dict[str, FilteredPoint]:
    """What a job needs of each point of a batch to run a filter on a shard of its trials.

    `root` is the folder of the results. Of each point are given `trials` of all shards, `settings`,
    the point `log_of` whose log it reads, whether `consistency` is kept, and the digests of what
    `log` and `runs` are made with.
    """
    layout, found = Layout(root), {}
    for point, given in points.items():
        trials = of_shard(given["trials"], shard, shards)
        found[point] = FilteredPoint(
            log=layout.log(study, given["log_of"], shard),
            settings=given["settings"],
            log_origin=origin(given["log"], trials),
            origin=origin(given["runs"], trials),
            log_of=given["log_of"],
            consistency=given["consistency"],
        )
    return found


def run_filter(
    study: str, name: str, points: Mapping[str, FilteredPoint], path: str | Path
) -> dict[str, float]:
    """Run the filter on one log after another and write all runs; the file appears whole or not.

    Returns the CPU seconds that each point took.
    """
    seconds = {}
    kept = plugins.study(study).kept_components
    with (
        atomic_write(path) as part,
        part.open("wb") as stream,
        RunsWriter(stream, kept) as writer,
    ):
        for point, given in points.items():
            begun = time.process_time()
            log = read_checked_log(given.log, study, given.log_of or point, given.log_origin)
            _, runs = run(log._replace(point=point), name, given.settings, given.consistency)
            writer.add(point, runs, given.origin)
            seconds[point] = time.process_time() - begun
    return seconds


def flown(log: Log, filter_: Any, settings: dict[str, Any]) -> Log:
    """The log of what happens on a filter's estimates, in a closed loop."""
    loop = plugins.study(log.study)
    assert isinstance(loop, ClosedLoop)
    estimate, runs = run(log, filter_, settings)
    return loop.flight(log, estimate, runs)


def read_checked_log(path: str, study: str, point: str, origin: str | None = None) -> Log:
    """The log at `path`, checked to be of that study, point and origin, with the study's topics."""
    log = read_log(path, study=study, point=point, origin=origin)
    scenario = plugins.study(study)
    if log.fields != scenario.topics(log.parameters):
        return read_log(path, scenario.stored(log.parameters), study, point)
    return log
