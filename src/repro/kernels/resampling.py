"""Weights and resampling of one trial, for kernels. Weights are (particles,)."""

import numpy as np

from repro.kernels import random
from repro.kernels.compiled import kernel
from repro.kernels.elementary import exp, log_of_normal

SYSTEMATIC, MULTINOMIAL = range(2)
SCHEMES = {"systematic": SYSTEMATIC, "multinomial": MULTINOMIAL}  # as settings name them
# Particles the sum of whose likelihoods is below this are weighted in logarithms.
UNDERFLOWS = 1e-200


@kernel
def total(values):
    """Sum in four interleaved parts, so that an addition need not wait for the one before."""
    a = b = c = d = 0.0
    whole = values.size // 4 * 4
    for i in range(0, whole, 4):
        a += values[i]
        b += values[i + 1]
        c += values[i + 2]
        d += values[i + 3]
    for i in range(whole, values.size):
        a += values[i]
    return (a + b) + (c + d)


@kernel
def maximum(values):
    """The largest that is not NaN, or -inf, in four interleaved parts."""
    a = b = c = d = -np.inf
    whole = values.size // 4 * 4
    for i in range(0, whole, 4):
        a = values[i] if values[i] > a else a
        b = values[i + 1] if values[i + 1] > b else b
        c = values[i + 2] if values[i + 2] > c else c
        d = values[i + 3] if values[i + 3] > d else d
    for i in range(whole, values.size):
        a = values[i] if values[i] > a else a
    return max(a, b, c, d)


@kernel
def weighted_total(weights, values):
    """Sum of weights times values, in four interleaved parts."""
    a = b = c = d = 0.0
    whole = values.size // 4 * 4
    for i in range(0, whole, 4):
        a += weights[i] * values[i]
        b += weights[i + 1] * values[i + 1]
        c += weights[i + 2] * values[i + 2]
        d += weights[i + 3] * values[i + 3]
    for i in range(whole, values.size):
        a += weights[i] * values[i]
    return (a + b) + (c + d)


@kernel
def weighted_mean(particles, weights, mean):
    """The estimate of one trial."""
    for component in range(len(particles)):
        mean[component] = weighted_total(weights, particles[component])


@kernel
def weighted_means(particles, weights, means):
    """The estimates of all trials, (trials, n)."""
    for trial in range(len(particles)):
        weighted_mean(particles[trial], weights[trial], means[trial])


@kernel
def normalise(weights):
    """Scale weights to the sum one. If they have no positive finite sum they become equal;
    returns whether that is so."""
    scale = 1.0 / total(weights)
    degenerate = not 0.0 < scale < np.inf
    for i in range(weights.size):
        weights[i] = 1.0 / weights.size if degenerate else weights[i] * scale
    return degenerate


@kernel
def normalise_logarithms(weights):
    """Turn log weights into weights as `normalise` does, in any common scale.

    The largest is subtracted first, so that a row that underflows as a whole keeps its order.
    """
    largest = maximum(weights)
    for i in range(weights.size):  # NaN if none is finite
        weights[i] = exp(weights[i] - largest)
    return normalise(weights)


@kernel
def effective_sample_size(weights):
    """1 / sum of squared weights."""
    return 1.0 / weighted_total(weights, weights)


@kernel
def effective_sample_sizes(weights, out):
    """Of each row of weights (rows, particles); out (rows,)."""
    for row in range(len(weights)):
        out[row] = effective_sample_size(weights[row])


@kernel
def draw_parents(weights, scheme, key, k, drawn, parents):
    """Indices of the particles that are drawn, as the weights.

    drawn (2 particles + 4,) or more: scratch.
    """
    if scheme == SYSTEMATIC:
        uniform = random.uniform(key, k, random.RESAMPLING)
        systematic(weights, uniform, parents)
    else:
        first = random.padded(weights.size + 1)
        random.fill_uniforms(key, k, random.RESAMPLING, drawn[:first])
        multinomial(weights, drawn[:first], drawn[first : first + weights.size], parents)


@kernel
def systematic(weights, uniform, parents):
    """Parents, ascending, by systematic resampling with one uniform.

    The children of particle i begin at ceil(N c - u), c the weights before it. So the parent of a
    child is how many other particles begin up to it: a count, then a sum, and no branches.
    """
    count = weights.size
    parents[:] = 0
    before = weights[0]
    for i in range(1, count):
        place = count * before - uniform
        begin = int(place)
        begin += begin < place
        if begin < count:
            parents[begin] += 1
        before += weights[i]
    parent = 0
    for child in range(count):
        parent += parents[child]
        parents[child] = parent


@kernel
def multinomial(weights, uniforms, upto, parents):
    """Parents, ascending, by multinomial resampling with N + 1 uniforms on (0, 1).

    Sorted uniforms are cumulated exponentials over their sum (Devroye, 1986). The parent of one is
    how many cumulative weights, but for the last, are not above it: all those in lower of N equal
    parts of (0, 1), which are counted in advance, and some in its own, which hardly are more than
    three. To look for them one by one would branch at random and cost three times as much.
    uniforms is overwritten, upto (N,) is scratch.
    """
    count, last = weights.size, weights.size - 1
    for j in range(count + 1):
        uniforms[j] = -log_of_normal(uniforms[j])
    scale = 1.0 / total(uniforms[: count + 1])
    point = cumulated = 0.0
    for j in range(count):
        point += uniforms[j] * scale
        cumulated += weights[j]
        uniforms[j], upto[j] = point, cumulated
    upto[last] = np.inf
    before = parents  # how many lie in lower parts
    before[:] = 0
    for i in range(last):
        part = int(upto[i] * count) + 1
        if part < count:
            before[part] += 1
    found = 0
    for part in range(count):
        found += before[part]
        before[part] = found
    for j in range(count):
        point = uniforms[j]
        i = before[min(int(point * count), last)]
        second, third = min(i + 1, last), min(i + 2, last)
        i += (upto[i] <= point) + (upto[second] <= point) + (upto[third] <= point)
        while upto[i] <= point:
            i += 1
        uniforms[j] = i
    for j in range(count):
        parents[j] = int(uniforms[j])


@kernel
def take(source, parents, out):
    """Copy the drawn particles, (n, particles)."""
    for component in range(len(source)):
        for j in range(parents.size):
            out[component, j] = source[component, parents[j]]
