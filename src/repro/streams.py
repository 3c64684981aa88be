"""Named random streams: one generator per trial, independent of shards, points and filters."""

import math
from collections.abc import Callable, Iterable
from functools import cached_property
from typing import Any
from zlib import crc32

import numpy as np

from repro.seed_sequences import Seed, seeds

Fill = Callable[[np.random.Generator, np.ndarray], object]  # draws into an array


class Streams:
    """The streams of one role (process, sensor, network, prior, `filter:<name>`), one per trial.

    A stream is named by (root seed, study, role, trial) alone, so that another shard, point of a
    sweep, or filter changes no number.
    """

    def __init__(self, root_seed: int, study: str, role: str, trials: Iterable[int]):
        role_key = (crc32(study.encode()), crc32(role.encode()))
        self._root_seed = root_seed
        self._spawn_keys = np.array([(*role_key, trial) for trial in trials]).reshape(-1, 3)

    @cached_property
    def generators(self) -> list[np.random.Generator]:
        """NumPy's generators, one a trial."""
        words = seeds(self._root_seed, self._spawn_keys, 4)  # as many as PCG64 takes
        sequences: list[Any] = list(map(Seed, words))  # NumPy's types name its own class alone
        return [np.random.Generator(np.random.PCG64(sequence)) for sequence in sequences]

    def keys(self) -> np.ndarray:
        """Keys of the counter-based generator of `repro.kernels.random`, (trials,) uint64.

        Of a child of each stream's seed sequence, so that they are independent of `generators`.
        """
        of_child = np.insert(self._spawn_keys, 3, 1, axis=1)
        return seeds(self._root_seed, of_child, 1)[:, 0]

    def __len__(self) -> int:
        return len(self._spawn_keys)

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
