"""A filter on some trials, step by step."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, NamedTuple

import numpy as np

from repro.errors import ReproError
from repro.filters import Filter
from repro.network.channels import Channels, Seen
from repro.runner.faults import Progress, Task, inside
from repro.streams import Streams


class BlockResult(NamedTuple):
    """What the trials of a block leave."""

    estimate: np.ndarray  # (trials, steps, n)
    claimed: np.ndarray | None  # claimed error variances, ([trials,] steps, n)
    degenerate: np.ndarray  # guarded updates, (trials,)
    recorded: dict[str, np.ndarray]
    flown: dict[str, np.ndarray]


class Block:
    """A filter on some trials side by side."""

    def __init__(
        self,
        task: Task,
        built: Filter,
        sees: tuple[str, ...],
        channels: Channels,
        streams: Streams,
        numbers: np.ndarray,
        *,
        steps: int,
        states: int,
        first_step: int,
        kept: tuple[str, ...] = (),
    ):
        """`numbers` are those of the trials; a study that begins with y(0) has first_step 0."""
        self._task, self._filter, self._sees = task, built, sees
        self._channels, self._streams, self._numbers = channels, streams, numbers
        self._first, self._kept = first_step, kept
        self._estimate = np.empty((len(numbers), steps, states))
        self._history: dict[str, list[Any]] = {}  # of what is kept of each step besides

    def run(self, progress: Progress | None = None) -> BlockResult:
        """All steps: the channels offer, the filter updates, its estimate goes back."""
        with self._inside("init(streams)", 0):
            self._state = self._filter.init(self._streams)
        mean = self._checked(self._mean(0), 0)
        if self._first == 1:
            self._keep(0, mean, None)
        steps = self._estimate.shape[1]
        for k in range(self._first, steps):
            offered = self._channels.at(k, self._fed_back(k, mean))
            seen = Seen(self._task.name, self._sees, offered)
            with self._inside("step(state, k, seen)", k):
                self._state = self._filter.step(self._state, k, seen)
            found = self._mean(k)
            over = self._channels.over(k, found)
            mean = self._checked(_held(found, mean, over), k)
            self._keep(k, mean, over)
            if progress is not None:
                progress.done(len(self._numbers) / (steps - self._first))
        return self._result()

    def _mean(self, k: int) -> np.ndarray:
        with self._inside("mean(state)", k):
            return np.asarray(self._filter.mean(self._state))

    def _fed_back(self, k: int, mean: np.ndarray) -> np.ndarray:
        """What the channels get of the filter; without a prediction of its own, its estimate."""
        if self._channels.on_prediction and self._filter.predicted:
            return self._filter.predicted(self._state, k)
        return mean

    def _keep(self, k: int, mean: np.ndarray, over: np.ndarray | None) -> None:
        """Keep the estimate of step k and what the filter says of it besides."""
        self._estimate[:, k] = mean
        say = {"claimed": self._filter.variance, "arrived": self._filter.arrived}
        for name in self._kept:
            function = say[name]
            if function is not None:
                steps = self._history.setdefault(name, [])
                with self._inside(f"what it has as {name}", k):
                    steps.append(_held(function(self._state), steps[-1] if steps else 0.0, over))
        if self._filter.diagnostics:
            for name, values in self._filter.diagnostics(self._state).items():
                self._history.setdefault(f"diagnostic {name}", []).append(values)

    def _result(self) -> BlockResult:
        history, recorded = self._history, self._channels.record()
        if "arrived" in history:
            recorded["arrived"] = np.stack(history.pop("arrived"), axis=1)
        claimed = history.pop("claimed", None)
        recorded |= {
            name.removeprefix("diagnostic "): np.stack(steps, axis=1)
            for name, steps in history.items()
        }
        guarded = self._filter.degenerate
        return BlockResult(
            self._estimate,
            None if claimed is None else np.stack(claimed, axis=-2),
            guarded(self._state) if guarded else np.zeros(len(self._numbers)),
            recorded,
            self._channels.flown(),
        )

    def _checked(self, mean: np.ndarray, k: int) -> np.ndarray:
        """The estimate, if it has the shape that it must have and is finite."""
        wanted = self._estimate[:, k].shape
        if mean.shape != wanted:
            raise ReproError(
                f"{self._task}: mean(state) has shape {mean.shape} at step {k}; "
                f"it must be (trials, n) = {wanted}"
            )
        if not np.isrealobj(mean) or mean.dtype == object:
            raise ReproError(
                f"{self._task}: mean(state) holds {mean.dtype} at step {k}; it must be real"
            )
        finite = np.isfinite(mean).all(axis=1)
        if not finite.all():
            trial = self._numbers[int(finite.argmin())]
            raise ReproError(
                f"{self._task}: the estimate of trial {trial} at step {k} is not finite"
            )
        return mean

    @contextmanager
    def _inside(self, function: str, k: int) -> Iterator[None]:
        trials = f"trials {self._numbers[0]} to {self._numbers[-1]}"
        with inside(self._task, f"{function} at step {k}, {trials}"):
            yield


def _held(values: Any, last: Any, over: np.ndarray | None) -> Any:
    """Values (trials, ...), but the last ones of trials that are over."""
    if over is None or not over.any():
        return values
    return np.where(over.reshape(-1, *(1,) * (np.ndim(values) - 1)), last, values)
