"""Random numbers from counters: Philox 4x32-10 of Salmon, Moraes, Dror, Shaw (2011).

A number is a function of the key of its stream (`Streams.keys`, one a trial) and of a counter:
the step, what it is drawn for, and its index. So nothing depends on the order of the draws, on
blocks and shards, or on what another filter draws; a loop over the index is vectorised. A word of
32 bits is a uniform: the largest normal is 6.8, which one in 10^11 would exceed.
"""

import numpy as np

from repro.kernels.compiled import kernel, scalar
from repro.kernels.elementary import TWO_52, log_of_normal, sine_cosine_of_turns, with_bits

# What a number is drawn for: the third word of the counter.
PRIOR, RESAMPLING, MOTION, FIRST_STAGE, ARRIVALS, COUPLING, FIRST_COUPLING = range(7)

LOW = np.uint64(0xFFFFFFFF)
HALF = np.uint64(32)
FIRST_FACTOR, SECOND_FACTOR = np.uint64(0xD2511F53), np.uint64(0xCD9E8D57)
FIRST_INCREMENT, SECOND_INCREMENT = np.uint64(0x9E3779B9), np.uint64(0xBB67AE85)


@scalar
def _round(c0, c1, c2, c3, k0, k1):
    first, second = FIRST_FACTOR * (c0 & LOW), SECOND_FACTOR * (c2 & LOW)
    c0, c1, c2, c3 = (second >> HALF) ^ c1 ^ k0, second, (first >> HALF) ^ c3 ^ k1, first
    return c0, c1, c2, c3, k0 + FIRST_INCREMENT, k1 + SECOND_INCREMENT


@scalar
def philox(c0, c1, c2, c3, k0, k1):
    """Four random words of 32 bits from a counter of four and a key of two, all uint64."""
    # Ten rounds, written out: a loop here would keep the caller's from being vectorised.
    c0, c1, c2, c3, k0, k1 = _round(c0, c1, c2, c3, k0, k1)
    c0, c1, c2, c3, k0, k1 = _round(c0, c1, c2, c3, k0, k1)
    c0, c1, c2, c3, k0, k1 = _round(c0, c1, c2, c3, k0, k1)
    c0, c1, c2, c3, k0, k1 = _round(c0, c1, c2, c3, k0, k1)
    c0, c1, c2, c3, k0, k1 = _round(c0, c1, c2, c3, k0, k1)
    c0, c1, c2, c3, k0, k1 = _round(c0, c1, c2, c3, k0, k1)
    c0, c1, c2, c3, k0, k1 = _round(c0, c1, c2, c3, k0, k1)
    c0, c1, c2, c3, k0, k1 = _round(c0, c1, c2, c3, k0, k1)
    c0, c1, c2, c3, k0, k1 = _round(c0, c1, c2, c3, k0, k1)
    c0, c1, c2, c3, k0, k1 = _round(c0, c1, c2, c3, k0, k1)
    return c0 & LOW, c1 & LOW, c2 & LOW, c3 & LOW


@scalar
def _uniform(word):
    """The middle of one of 2^32 parts of (0, 1)."""
    return (with_bits(np.int64(word) + TWO_52) - (4503599627370496.0 - 0.5)) * 2.0**-32


@scalar
def uniforms(key, step, purpose, index):
    """Four uniforms on (0, 1), odd multiples of 2^-33."""
    w0, w1, w2, w3 = philox(
        np.uint64(index), np.uint64(step), np.uint64(purpose), np.uint64(0), key & LOW, key >> HALF
    )
    return _uniform(w0), _uniform(w1), _uniform(w2), _uniform(w3)


@scalar
def normals(first, second):
    """Two standard normals from two uniforms on (0, 1), by Box and Muller (1958)."""
    radius = np.sqrt(-2.0 * log_of_normal(first))
    sine, cosine = sine_cosine_of_turns(second)
    return radius * cosine, radius * sine


@kernel
def uniform(key, step, purpose):
    """One uniform on (0, 1)."""
    return uniforms(key, step, purpose, 0)[0]


@kernel
def fill_uniforms(key, step, purpose, out):
    """Uniforms on (0, 1); out (4 m,), that of index i at i, m + i, 2 m + i, 3 m + i."""
    m = out.size // 4
    first, second, third, fourth = out[:m], out[m : 2 * m], out[2 * m : 3 * m], out[3 * m :]
    for i in range(m):
        first[i], second[i], third[i], fourth[i] = uniforms(key, step, purpose, i)


@kernel
def fill_normals(key, step, purpose, out):
    """Standard normals; out (4 m,). Two loops: one would be too long to be run ahead."""
    fill_uniforms(key, step, purpose, out)
    half = out.size // 2
    first, second = out[:half], out[half:]
    for i in range(half):
        first[i], second[i] = normals(first[i], second[i])


@scalar
def padded(count):
    """The length of an array for so many numbers: the next multiple of four."""
    return (count + 3) // 4 * 4


@kernel
def uniforms_of(keys, step, purpose, out):
    """Uniforms on (0, 1) of each stream, for callers that are plain NumPy; out (trials, 4 m)."""
    for trial in range(keys.size):
        fill_uniforms(keys[trial], step, purpose, out[trial])


@kernel
def normals_of(keys, step, purpose, out):
    """Standard normals of each stream, for callers that are plain NumPy; out (trials, 4 m)."""
    for trial in range(keys.size):
        fill_normals(keys[trial], step, purpose, out[trial])
