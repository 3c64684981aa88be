"""A filter on some trials, step by step."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from repro.errors import ReproError
from repro.filters import Filter
from repro.network.channels import Channels, Seen
from repro.runner.faults import Inside, Progress, Task
from repro.statistics.consistency import INNOVATION
from repro.streams import Streams

# Axes of the arrays that a filter returns.
SHAPES = {
    "mean": ("trials, n",),
    "diagnostics": ("trials",),
    "predicted": ("trials, n",),
    "variance": ("n", "trials, n"),
    "arrived": ("trials",),
    "degenerate": ("trials",),
    "covariance": ("d, d", "trials, d, d"),
    "normalised_innovation": ("trials",),
}


class BlockResult(NamedTuple):
    """What the trials of a block leave."""

    estimate: np.ndarray  # (trials, steps, n)
    claimed: np.ndarray | None  # claimed error variances, ([trials,] steps, n)
    degenerate: np.ndarray  # guarded updates, (trials,)
    recorded: dict[str, np.ndarray]
    flown: dict[str, np.ndarray]
    covariances: dict[str, np.ndarray]  # claimed, (trials, steps, d, d), of groups of components


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
        judged: Mapping[str, Sequence[int]] | None = None,
    ):
        """`numbers` are those of the trials; a study that begins with y(0) has first_step 0.

        `judged` are the components whose claimed covariance is kept, by the name of their group.
        """
        self._task, self._filter, self._sees = task, built, sees
        self._channels, self._streams, self._numbers = channels, streams, numbers
        self._first, self._kept, self._judged = first_step, kept, judged or {}
        # (steps, n, trials), as filters have it: to write (trials, steps, n) step by step is slow
        self._estimate = np.empty((steps, states, len(numbers)))
        self._trials = f"trials {numbers[0]} to {numbers[-1]}"
        self._lengths = {"trials": len(numbers), "n": states}
        self._history: dict[str, list[Any]] = {}  # of what is kept of each step besides

    def run(self, progress: Progress | None = None) -> BlockResult:
        """All steps: the channels offer, the filter updates, its estimate goes back."""
        with self._inside("init(streams)", 0):
            self._state = self._filter.init(self._streams)
        mean = self._checked(self._mean(0), 0)
        if self._first == 1:
            self._keep(0, mean, None)
        steps = len(self._estimate)
        for k in range(self._first, steps):
            offered = self._channels.at(k, self._fed_back(k, mean))
            with self._inside("step(state, k, seen)", k):
                seen = Seen(self._task.name, self._sees, offered)
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
            return self._optional("predicted", k, self._filter.predicted, self._state, k)
        return mean

    def _keep(self, k: int, mean: np.ndarray, over: np.ndarray | None) -> None:
        """Keep the estimate of step k and what the filter says of it besides."""
        self._estimate[k] = mean.T
        for name in self._kept:
            function = getattr(self._filter, name)
            if function is not None:
                values = self._optional(name, k, function, self._state)
                steps = self._history.setdefault(name, [])
                steps.append(_held(values, steps[-1] if steps else 0.0, over))
        self._keep_claims(k, over)
        if self._filter.diagnostics:
            with self._inside("diagnostics(state)", k):
                found = dict(self._filter.diagnostics(self._state))
            for name, values in found.items():
                steps = self._history.setdefault(f"diagnostic {name}", [])
                steps.append(self._shaped("diagnostics", f"(state)['{name}']", k, values))

    def _keep_claims(self, k: int, over: np.ndarray | None) -> None:
        """Keep what says whether the filter's own covariance is true."""
        covariance, innovation = self._filter.covariance, self._filter.normalised_innovation
        for name, components in self._judged.items():
            if covariance is not None:
                of = self._optional("covariance", k, covariance, self._state, components)
                steps = self._history.setdefault(f"covariance {name}", [])
                of_trials = np.broadcast_to(of, (len(self._numbers), *of.shape[-2:]))
                steps.append(_held(of_trials, steps[-1] if steps else 0.0, over))
        if self._judged and innovation is not None:
            steps = self._history.setdefault("innovation", [])
            steps.append(self._optional("normalised_innovation", k, innovation, self._state))

    def _result(self) -> BlockResult:
        history, recorded = self._history, self._channels.record()
        claims = {
            name.removeprefix("covariance "): np.stack(history.pop(name), axis=1)
            for name in [name for name in history if name.startswith("covariance ")]
        }
        if "innovation" in history:
            recorded[INNOVATION] = _over_steps(history.pop("innovation"))
        if "arrived" in history:
            recorded["arrived"] = _over_steps(history.pop("arrived")) > 0.5  # the likelier
        claimed = history.pop("variance", None)
        recorded |= {
            name.removeprefix("diagnostic "): _over_steps(steps) for name, steps in history.items()
        }
        degenerate = np.zeros(len(self._numbers))
        if self._filter.degenerate:
            last = len(self._estimate) - 1
            degenerate = self._optional("degenerate", last, self._filter.degenerate, self._state)
        return BlockResult(
            self._estimate.transpose(2, 0, 1),
            None if claimed is None else _over_steps(claimed, shared=claimed[0].ndim == 1),
            degenerate,
            recorded,
            self._channels.flown(),
            claims,
        )

    def _checked(self, mean: np.ndarray, k: int) -> np.ndarray:
        """The estimate, if it has the shape that it must have and is finite."""
        self._shaped("mean", "(state)", k, mean)
        finite = np.isfinite(mean)
        if not finite.all():
            trial = self._numbers[int(finite.all(axis=1).argmin())]
            raise ReproError(
                f"{self._task}: the estimate of trial {trial} at step {k} is not finite; "
                "fix step or mean, for instance a division by zero"
            )
        return mean

    def _optional(self, name: str, k: int, function: Any, *arguments: Any) -> np.ndarray:
        """What an optional function of the filter returns, checked for its shape."""
        signature = {"predicted": "(state, k)", "covariance": "(state, components)"}.get(
            name, "(state)"
        )
        with self._inside(name + signature, k):
            values = function(*arguments)
        lengths = {"d": len(arguments[1])} if name == "covariance" else {}
        return self._shaped(name, signature, k, values, **lengths)

    def _shaped(self, name: str, signature: str, k: int, values: Any, **lengths: int) -> np.ndarray:
        """The values as an array, if real and of a shape that the function may return."""
        lengths |= self._lengths
        allowed = {
            f"({shape})": tuple(lengths[axis] for axis in shape.split(", "))
            for shape in SHAPES[name]
        }
        array = np.asarray(values)
        if array.shape not in allowed.values():
            expected = " or ".join(f"{axes} = {shape}" for axes, shape in allowed.items())
            raise ReproError(
                f"{self._task}: {name}{signature} has shape {array.shape} at step {k}, "
                f"{self._trials}; it must be {expected}"
            )
        if array.dtype.kind not in "fiub":
            raise ReproError(
                f"{self._task}: {name}{signature} holds {array.dtype} at step {k}, "
                f"{self._trials}; it must be real"
            )
        return array

    def _inside(self, function: str, k: int) -> Inside:
        return Inside(self._task, function, " at step ", k, ", ", self._trials)


def _over_steps(values: list[np.ndarray], shared: bool = False) -> np.ndarray:
    """Values (trials, ...) of each step as (trials, steps, ...); (steps, n) if trials share them.

    A view of the steps one after another, which is written faster.
    """
    if shared:
        return np.stack(values)
    steps = np.stack([of_step.T for of_step in values])
    return steps.transpose(steps.ndim - 1, *range(steps.ndim - 1))


def _held(values: Any, last: Any, over: np.ndarray | None) -> Any:
    """Values (trials, ...), but the last ones of trials that are over."""
    if over is None or not over.any():
        return values
    return np.where(over.reshape(-1, *(1,) * (np.ndim(values) - 1)), last, values)
