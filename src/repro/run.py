"""Run one filter over one log, batched over trials."""

from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np

from repro import plugins
from repro.atomic import atomic_write
from repro.errors import ReproError, computing
from repro.filters import Filter
from repro.logs import Log, read_log, write_log
from repro.network.channels import Channels, Seen
from repro.parameters.settings import typed_settings
from repro.statistics.runs import Runs
from repro.streams import Streams
from repro.studies import ClosedLoop, Study


def run(log: Log, name: str, settings: dict[str, Any]) -> tuple[np.ndarray, Runs]:
    """Estimates (trials, steps, n) and runs of a filter on every trial of a log.

    Without /truth in the log the errors are NaN. Raises ReproError if the filter breaks its
    contract.
    """
    study, module = plugins.study(log.study), plugins.filter_module(name)
    model = study.model(log.parameters)
    filter_ = module.build(model, typed_settings(module, name, settings))
    states = len(model.initial_mean)
    size = max(1, study.systems_per_block // filter_.particles)
    blocks = [
        _Block(log, name, module, filter_, states, study, slice(first, first + size)).run()
        for first in range(0, len(log.trials), size)
    ]
    estimate = np.concatenate([block.estimate for block in blocks])
    flown = {t: np.concatenate([block.flown[t] for block in blocks]) for t in blocks[0].flown}
    log = log._replace(values=log.values | flown)  # a closed loop decides its own truth
    error = study.error(log, estimate) if "/truth" in log.values else np.full_like(estimate, np.nan)
    return estimate, Runs(
        error=error,
        claimed=_claimed([block.claimed for block in blocks]),
        degenerate=np.concatenate([block.degenerate for block in blocks]),
        recorded={
            key: np.concatenate([block.recorded[key] for block in blocks])
            for key in blocks[0].recorded
        },
        flown=flown,
    )


def _claimed(of_blocks: list[Any]) -> np.ndarray | None:
    """Claimed variances of all blocks; (steps, n) if they are the same in every trial."""
    first = of_blocks[0]
    return first if first is None or first.ndim == 2 else np.concatenate(of_blocks)


class _Result(NamedTuple):
    """What the trials of a block leave."""

    estimate: np.ndarray  # (trials, steps, n)
    claimed: np.ndarray | None  # claimed error variances, ([trials,] steps, n)
    degenerate: np.ndarray  # guarded updates, (trials,)
    recorded: dict[str, np.ndarray]
    flown: dict[str, np.ndarray]


class _Block:
    """A filter on some trials of a log, side by side."""

    def __init__(
        self,
        log: Log,
        name: str,
        module: ModuleType,
        filter_: Filter,
        states: int,
        study: Study,
        trials: slice,
    ):
        self._name, self._module, self._filter, self._study = name, module, filter_, study
        self._numbers, self._steps = log.trials[trials].tolist(), log.steps
        self._estimate = np.empty((len(self._numbers), log.steps, states))
        self._first = study.first_step(log.parameters)
        self._channels: Channels = study.channels(log, trials)
        # Filters that share a stream draw the same numbers.
        stream = f"filter:{getattr(module, 'STREAM', name)}"
        self._state = filter_.init(Streams(log.seed, log.study, stream, self._numbers))
        self._history: dict[str, list[Any]] = {}  # of what is kept of each step

    def run(self) -> _Result:
        """All steps: the channels offer, the filter updates, its estimate goes back."""
        mean = self._checked(self._filter.mean(self._state), 0)
        if self._first == 1:
            self._keep(0, mean, None)
        for k in range(self._first, self._steps):
            seen = Seen(
                self._name, self._module.SEES, self._channels.at(k, self._fed_back(k, mean))
            )
            self._state = self._filter.step(self._state, k, seen)
            found = self._filter.mean(self._state)
            over = self._channels.over(k, found)
            mean = self._checked(_held(found, mean, over), k)
            self._keep(k, mean, over)
        return self._result()

    def _fed_back(self, k: int, mean: np.ndarray) -> np.ndarray:
        """What the channels get of the filter; without a prediction of its own, its estimate."""
        if self._channels.on_prediction and self._filter.predicted:
            return self._filter.predicted(self._state, k)
        return mean

    def _keep(self, k: int, mean: np.ndarray, over: np.ndarray | None) -> None:
        """Keep the estimate of step k and what the filter says of it besides."""
        self._estimate[:, k] = mean
        kept = {}
        if self._filter.variance and self._study.keeps_claimed_variance:
            kept["claimed"] = self._filter.variance(self._state)
        if self._filter.arrived and self._study.keeps_inferred_arrivals:
            kept["arrived"] = self._filter.arrived(self._state)
        for name, values in kept.items():
            steps = self._history.setdefault(name, [])
            steps.append(_held(values, steps[-1] if steps else 0.0, over))
        if self._filter.diagnostics:
            for name, values in self._filter.diagnostics(self._state).items():
                self._history.setdefault(f"diagnostic {name}", []).append(values)

    def _result(self) -> _Result:
        history = self._history
        recorded = self._channels.record()
        if "arrived" in history:
            recorded["arrived"] = np.stack(history.pop("arrived"), axis=1)
        claimed = history.pop("claimed", None)
        recorded |= {
            name.removeprefix("diagnostic "): np.stack(steps, axis=1)
            for name, steps in history.items()
        }
        guarded = self._filter.degenerate
        return _Result(
            self._estimate,
            None if claimed is None else np.stack(claimed, axis=-2),
            guarded(self._state) if guarded else np.zeros(len(self._numbers)),
            recorded,
            self._channels.flown(),
        )

    def _checked(self, mean: Any, k: int) -> np.ndarray:
        """The estimate, if it has the shape that it must have and is finite."""
        mean = np.asarray(mean)
        wanted = self._estimate[:, k].shape
        if mean.shape != wanted:
            raise ReproError(
                f"filter {self._name}: mean(state) has shape {mean.shape} at step {k}; "
                f"it must be (trials, n) = {wanted}"
            )
        finite = np.isfinite(mean).all(axis=1)
        if not finite.all():
            trial = self._numbers[int(finite.argmin())]
            raise ReproError(
                f"filter {self._name}: the estimate of trial {trial} at step {k} is not finite"
            )
        return mean


def _held(values: Any, last: Any, over: np.ndarray | None) -> Any:
    """Values (trials, ...), but the last ones of trials that are over."""
    if over is None or not over.any():
        return values
    return np.where(over.reshape(-1, *(1,) * (np.ndim(values) - 1)), last, values)


def run_filter(
    log_path: str,
    study: str,
    point: str,
    name: str,
    settings: dict[str, Any],
    path: str | Path,
    flight_path: str | Path | None = None,
) -> None:
    """Read a log, run the filter and write its runs; the file appears whole or not at all.

    A closed loop writes the log of what was flown to `flight_path`.
    """
    log = read_checked_log(log_path, study, point)
    with computing(f"filter {name} on {study}, {point}"):
        estimate, runs = run(log, name, settings)
    if flight_path is not None:
        loop = plugins.study(study)
        assert isinstance(loop, ClosedLoop)
        write_log(flight_path, loop.flight(log, estimate, runs), loop.period(log.parameters))
    arrays = {f"recorded_{key}": value for key, value in runs.recorded.items()}
    if runs.claimed is not None:
        arrays["claimed"] = runs.claimed
    with atomic_write(path) as part, part.open("wb") as stream:
        np.savez(stream, trials=log.trials, error=runs.error, degenerate=runs.degenerate, **arrays)


def read_checked_log(path: str, study: str, point: str) -> Log:
    """The log at `path`, checked to be of that study and point with that study's topics."""
    log = read_log(path, study=study, point=point)
    wanted = plugins.study(study).topics(log.parameters)
    return log if log.fields == wanted else read_log(path, wanted, study, point)
