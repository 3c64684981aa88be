"""Run one filter over one log, batched over trials."""

from importlib import import_module
from pathlib import Path
from types import ModuleType

import numpy as np

from repro.atomic import atomic_write
from repro.errors import ReproError, computing
from repro.logs import Log, read_log, write_log
from repro.network.channels import Seen
from repro.statistics.runs import Runs
from repro.streams import Streams
from repro.studies import study_module

# Small enough for a block's covariances to stay in the cache; a study of clouds sets its own.
TRIALS_A_BLOCK = 250


def filter_module(name: str) -> ModuleType:
    """The module of a filter by its name, checked for what the runner needs of it."""
    try:
        module = import_module(f"repro.filters.{name}")
    except ModuleNotFoundError as error:
        if error.name != f"repro.filters.{name}":
            raise
        raise ReproError(f"filter {name}: there is no src/repro/filters/{name}.py") from None
    for attribute in ("LABEL", "SEES", "build"):
        if not hasattr(module, attribute):
            raise ReproError(f"filter {name}: src/repro/filters/{name}.py defines no {attribute}")
    return module


def run(log: Log, name: str, settings: dict) -> tuple[np.ndarray, Runs]:
    """Estimates (trials, steps, n) and runs of a filter on every trial of a log.

    Without /truth in the log the errors are NaN.
    """
    study = study_module(log.study)
    filter_ = filter_module(name).build(study.model(log.parameters), settings)
    block = getattr(study, "TRIALS_A_BLOCK", TRIALS_A_BLOCK)
    block = max(1, block // filter_.particles)
    blocks = [
        _run_block(log, name, settings, slice(first, first + block))
        for first in range(0, len(log.trials), block)
    ]
    estimates, claimed, degenerate, recorded, flown = zip(*blocks, strict=True)
    estimate = np.concatenate(estimates)
    flown = {topic: np.concatenate([f[topic] for f in flown]) for topic in flown[0]}
    log = log._replace(values=log.values | flown)  # a closed loop decides its own truth
    error = study.error(log, estimate) if "/truth" in log.values else np.full_like(estimate, np.nan)
    shared = claimed[0] is None or claimed[0].ndim == 2
    return estimate, Runs(
        error=error,
        claimed=claimed[0] if shared else np.concatenate(claimed),
        degenerate=np.concatenate(degenerate),
        recorded={key: np.concatenate([r[key] for r in recorded]) for key in recorded[0]},
        flown=flown,
    )


def _run_block(log: Log, name: str, settings: dict, trials: slice):
    study, module = study_module(log.study), filter_module(name)
    model = study.model(log.parameters)
    filter_ = module.build(model, settings)
    channels = study.channels(log, trials, log.parameters)
    numbers = log.trials[trials].tolist()
    steps = log.steps
    stream = getattr(module, "STREAM", name)  # filters that share it draw the same numbers
    state = filter_.init(Streams(log.seed, log.study, f"filter:{stream}", numbers))
    estimate = np.empty((len(numbers), steps, len(model.initial_mean)))
    first = study.first_step(log.parameters) if hasattr(study, "first_step") else 1
    mean = filter_.mean(state)
    if first == 1:
        estimate[:, 0] = _checked(mean, name, 0, estimate[:, 0].shape, numbers)
    claims = filter_.variance and getattr(study, "CLAIMED_VARIANCE", True)
    claimed = [filter_.variance(state)] * first if claims else None
    diagnosed = [filter_.diagnostics(state)] * first if filter_.diagnostics else None
    infers = filter_.arrived and getattr(study, "INFERRED_ARRIVALS", False)
    arrived = np.zeros((len(numbers), steps)) if infers else None
    on_prediction = filter_.predicted and getattr(channels, "ON_PREDICTION", False)
    loop_over = getattr(channels, "over", lambda k, mean: None)
    for k in range(first, steps):
        # A filter without a prediction of its own is scheduled on its last estimate.
        fed_back = filter_.predicted(state, k) if on_prediction else mean
        seen = Seen(name, module.SEES, channels.at(k, fed_back))
        state = filter_.step(state, k, seen)
        found = filter_.mean(state)
        over = loop_over(k, found)
        mean = _checked(_held(found, mean, over), name, k, estimate[:, k].shape, numbers)
        estimate[:, k] = mean
        if claimed is not None:
            claimed.append(_held(filter_.variance(state), claimed[-1] if claimed else 0.0, over))
        if arrived is not None:
            arrived[:, k] = _held(filter_.arrived(state), arrived[:, k - 1], over)
        if diagnosed is not None:
            diagnosed.append(filter_.diagnostics(state))
    recorded = channels.record()
    if arrived is not None:
        recorded["arrived"] = arrived
    for key in diagnosed[0] if diagnosed else ():
        recorded[key] = np.stack([of_step[key] for of_step in diagnosed], axis=1)
    if claimed is not None:
        claimed = np.stack(claimed, axis=-2)  # (steps, n) if the same for every trial
    guarded = filter_.degenerate(state) if filter_.degenerate else np.zeros(len(numbers))
    flown = channels.flown() if hasattr(channels, "flown") else {}
    return estimate, claimed, guarded, recorded, flown


def _held(values: np.ndarray, last, over: np.ndarray | None) -> np.ndarray:
    """Values (trials, ...), but the last ones of trials that are over."""
    if over is None or not over.any():
        return values
    return np.where(over.reshape(-1, *(1,) * (np.ndim(values) - 1)), last, values)


def _checked(mean, name: str, k: int, shape: tuple[int, int], numbers: list[int]) -> np.ndarray:
    mean = np.asarray(mean)
    if mean.shape != shape:
        raise ReproError(
            f"filter {name}: mean(state) has shape {mean.shape} at step {k}; "
            f"wanted is (trials, n) = {shape}"
        )
    finite = np.isfinite(mean).all(axis=1)
    if not finite.all():
        trial = numbers[int(finite.argmin())]
        raise ReproError(f"filter {name}: the estimate of trial {trial} at step {k} is not finite")
    return mean


def run_filter(
    log_path: str,
    study: str,
    point: str,
    name: str,
    settings: dict,
    path: str | Path,
    flight_path: str | Path | None = None,
) -> None:
    """Read a log, run the filter and write its runs; the file appears whole or not at all.

    A closed loop writes the log of what was flown to `flight_path`.
    """
    log = read_wanted_log(log_path, study, point)
    with computing(f"filter {name} on {study}, {point}"):
        estimate, runs = run(log, name, settings)
    if flight_path is not None:
        module = study_module(study)
        write_log(flight_path, module.flight(log, estimate, runs), module.period(log.parameters))
    arrays = {f"recorded_{key}": value for key, value in runs.recorded.items()}
    if runs.claimed is not None:
        arrays["claimed"] = runs.claimed
    with atomic_write(path) as part, part.open("wb") as stream:
        np.savez(stream, trials=log.trials, error=runs.error, degenerate=runs.degenerate, **arrays)


def read_wanted_log(path: str, study: str, point: str) -> Log:
    """The log at `path`, checked to be of that study and point with that study's topics."""
    log = read_log(path, study=study, point=point)
    wanted = study_module(study).topics(log.parameters)
    return log if log.fields == wanted else read_log(path, wanted, study, point)
