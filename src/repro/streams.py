"""Named random streams: one generator per trial, independent of shards, points and filters."""

import math
from collections.abc import Callable, Iterable
from functools import cached_property
from zlib import crc32

import numpy as np

Fill = Callable[[np.random.Generator, np.ndarray], object]  # draws into an array


class Streams:
    """The streams of one role (process, sensor, network, prior, `filter:<name>`), one per trial.

    A stream is named by (root seed, study, role, trial) alone, so that another shard, point of a
    sweep, or filter changes no number.
    """

    def __init__(self, root_seed: int, study: str, role: str, trials: Iterable[int]):
        self._root_seed, self._trials = root_seed, list(trials)
        self._role_key = crc32(study.encode()), crc32(role.encode())

    @cached_property
    def generators(self) -> list[np.random.Generator]:
        """NumPy's generators, one a trial."""
        return [
            np.random.Generator(np.random.PCG64(self._sequence(trial))) for trial in self._trials
        ]

    def keys(self) -> np.ndarray:
        """Keys of the counter-based generator of `repro.kernels.random`, (trials,) uint64.

        Of a child of each stream's seed sequence, so that they are independent of `generators`.
        """
        keys = [self._sequence(trial, 1).generate_state(1, np.uint64) for trial in self._trials]
        return np.concatenate(keys) if keys else np.empty(0, dtype=np.uint64)

    def _sequence(self, *trial_and_child: int) -> np.random.SeedSequence:
        spawn_key = (*self._role_key, *trial_and_child)
        return np.random.SeedSequence(self._root_seed, spawn_key=spawn_key)

    def __len__(self) -> int:
        return len(self._trials)

    def _draw(self, shape: tuple[int, ...], fill: Fill) -> np.ndarray:
        drawn = np.empty((len(self), *shape))
        for generator, row in zip(self.generators, drawn, strict=True):
            fill(generator, row)
        return drawn

    def standard_normal(self, *shape: int) -> np.ndarray:
        """Standard normals, shape (trials, *shape)."""
        return self._draw(shape, lambda generator, row: generator.standard_normal(out=row))

    def uniform(self, *shape: int) -> np.ndarray:
        """Uniforms on [0, 1), shape (trials, *shape)."""
        if math.prod(shape) == 1:  # the same numbers; a call into an array costs three times more
            drawn = np.array([generator.random() for generator in self.generators])
            return drawn.reshape(len(self), *shape)
        return self._draw(shape, lambda generator, row: generator.random(out=row))
