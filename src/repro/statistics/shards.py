"""Runs shard by shard, so that a table never holds all trials of a study in memory."""

import copy
import itertools
import os
import tempfile
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any

import numpy as np

from repro.statistics.runs import Runs

BLOCK = 2**20  # numbers of a quantity that are in memory at once


class Columns:
    """A quantity of every trial and step, from shards (trials, steps); read some steps at a time.

    The trials of a step lie end to end, so that no sum over them depends on the shards. Beyond one
    shard the numbers are in a temporary file.
    """

    def __init__(self, shards: Iterator[np.ndarray], trials: Sequence[int]):
        self.trials = self._in_all = sum(trials)
        self._chosen, first = None, next(shards)
        self.steps = first.shape[1]
        self._held = np.ascontiguousarray(first.T) if len(trials) == 1 else None
        if self._held is None:
            self._file = tempfile.TemporaryFile()  # noqa: SIM115 - it lives as long as this does
            self._write(0, first)
            for shard, begin in zip(shards, np.cumsum(trials[:-1]).tolist(), strict=True):
                self._write(begin, shard)

    def _write(self, begin: int, shard: np.ndarray) -> None:
        for k, of_step in enumerate(np.ascontiguousarray(shard.T, dtype=float)):
            data, place = of_step.data.cast("B"), 8 * (k * self._in_all + begin)
            while data:  # a disk that fills up takes a part, and then fails
                done = os.pwrite(self._file.fileno(), data, place)
                data, place = data[done:], place + done

    def only(self, chosen: np.ndarray) -> "Columns":
        """The quantity of some of the trials: `chosen` is (trials,) of flags."""
        few = copy.copy(self)
        few._chosen, few.trials = chosen, int(chosen.sum())
        return few

    def mean_over_steps(self) -> np.ndarray:
        """Of each trial, (trials,); step by step, so that no sum depends on the blocks."""
        total = np.zeros(self.trials)
        for block in self.blocks():
            for of_step in block:
                total += of_step
        return total / self.steps

    def blocks(self) -> Iterator[np.ndarray]:
        """All steps in order, some at a time, (steps, trials)."""
        for block in self._blocks():
            yield block if self._chosen is None else block.compress(self._chosen, axis=1)

    def _blocks(self) -> Iterator[np.ndarray]:
        at_once = max(1, BLOCK // self._in_all)
        for k in range(0, self.steps, at_once):
            rows = min(at_once, self.steps - k)
            if self._held is not None:
                yield self._held[k : k + rows]
            else:
                place, size = 8 * k * self._in_all, 8 * rows * self._in_all
                read = os.pread(self._file.fileno(), size, place)
                yield np.frombuffer(read).reshape(rows, self._in_all)


def merged(shards: Iterable[np.ndarray]) -> np.ndarray:
    """Shards end to end. Of several the numbers stay in a temporary file until they are used."""
    first, *rest = itertools.islice(shards := iter(shards), 2)
    if not rest:
        return first
    trials = 0
    with tempfile.TemporaryFile() as file:
        for shard in itertools.chain((first, *rest), shards):
            file.write(np.ascontiguousarray(shard, dtype=first.dtype).data)
            trials += len(shard)
        return np.memmap(file, first.dtype, "r", shape=(trials, *first.shape[1:]))


class Shards:
    """The runs of a filter on a point, of which one shard at a time is in memory."""

    def __init__(self, load: Sequence[Callable[[], Runs]], trials: Sequence[int]):
        """One function a shard that loads it, and the number of its trials."""
        self._load, self._trials = load, trials
        self.first = load[0]()

    @property
    def trials(self) -> int:
        """How many there are in all shards."""
        return sum(self._trials)

    def each(self, quantity: Callable[[Runs], np.ndarray]) -> Any:
        """A quantity of all trials, from one of a shard's.

        An array (trials,) if the quantity is (trials,); Columns if it is (trials, steps).
        """
        of_shards = (quantity(runs) for runs in self)
        first = next(of_shards)
        if first.ndim == 1:
            return np.concatenate([first, *of_shards])
        return Columns(itertools.chain([first], of_shards), self._trials)

    def __iter__(self) -> Iterator[Runs]:
        yield self.first
        for load in self._load[1:]:
            yield load()
