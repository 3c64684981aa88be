"""Seeds of many random streams at once: those of numpy.random.SeedSequence, bit by bit.

NumPy makes one sequence in tens of microseconds, as many as a trial of some simulations takes. The
algorithm is M. E. O'Neill's, "Developing a seed_seq Alternative" (pcg-random.org, 2015), with the
constants of NumPy, which promises to keep it.
"""

from typing import Any

import numpy as np
from numpy.random.bit_generator import ISeedSequence

WORDS = 4  # of the pool, of 32 bits
FIRST_A, FACTOR_A = 0x43B0D7E5, 0x931E8875  # of the pool's hash
FIRST_B, FACTOR_B = 0x8B51F9DD, 0x58F38DED  # of the output's hash
FACTOR_LEFT, FACTOR_RIGHT = np.uint32(0xCA01F9DD), np.uint32(0x4973F715)
SHIFT = np.uint32(16)


class Seed(ISeedSequence):
    """The words of one sequence, as a generator asks for them."""

    def __init__(self, words: np.ndarray):
        self._words = words

    def generate_state(self, n_words: int, dtype: Any = np.uint32) -> np.ndarray:
        """The words; a generator asks for as many as were computed."""
        assert len(self._words) == n_words and self._words.dtype == dtype
        return self._words


def seeds(root_seed: int, keys: np.ndarray, count: int) -> np.ndarray:
    """`count` words of 64 bits of each sequence, (sequences, count) uint64.

    Those of SeedSequence(root_seed, spawn_key=key) for each row of `keys`, integers below 2^32.
    """
    pool_hash = _Hash(FIRST_A, FACTOR_A)
    root = [root_seed >> at & 0xFFFFFFFF for at in range(0, max(root_seed.bit_length(), 1), 32)]
    root += [0] * (WORDS - len(root))
    keys = keys.astype(np.uint32)
    entropy = [np.full(len(keys), word, dtype=np.uint32) for word in root] + list(keys.T)
    pool = [pool_hash(word) for word in entropy[:WORDS]]
    for source in range(WORDS):
        for target in range(WORDS):
            if source != target:
                pool[target] = _mixed(pool[target], pool_hash(pool[source]))
    for word in entropy[WORDS:]:
        pool = [_mixed(of_pool, pool_hash(word)) for of_pool in pool]
    output_hash = _Hash(FIRST_B, FACTOR_B)
    state = [output_hash(pool[i % WORDS]) for i in range(2 * count)]
    return np.stack(state, axis=1).astype("<u4").view("<u8").astype(np.uint64)


class _Hash:
    """A hash of words whose constant is another at every call."""

    def __init__(self, first: int, factor: int):
        self._constant, self._factor = first, factor

    def __call__(self, words: np.ndarray) -> np.ndarray:
        hashed = words ^ np.uint32(self._constant)
        self._constant = self._constant * self._factor & 0xFFFFFFFF
        hashed *= np.uint32(self._constant)
        return hashed ^ hashed >> SHIFT


def _mixed(pool: np.ndarray, word: np.ndarray) -> np.ndarray:
    mixed = FACTOR_LEFT * pool - FACTOR_RIGHT * word
    return mixed ^ mixed >> SHIFT
