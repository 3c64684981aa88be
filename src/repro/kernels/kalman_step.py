"""Steps of extended Kalman filters on many systems at once [unknown_losses (4), (5)].

Loops over the components; the innermost is over systems, so that it is vectorised. An estimate is
(n, systems); a covariance is its upper triangle row by row, packed as (n (n + 1) / 2, systems).
The systems are worked through in parts of PART, whose rows stay in the cache.

A matrix of a model, a Jacobian for instance, is the terms of its rows, five arrays: columns,
weights and places (m, terms), ends (m, 2), slabs (., systems). Up to ends[i, 0] the entry of row
i in columns[i, t] is the constant weights[i, t]; these are a multiple of four terms, filled up
with zeros. From there up to ends[i, 1] it varies with the system and is slabs[places[i, t]].
"""

from repro.kernels.compiled import kernel, scalar
from repro.kernels.elementary import log

PART = 256  # systems


@scalar
def packed(i, j, n):
    """Place of the entry (i, j) of a symmetric matrix (n, n) in its packed triangle."""
    a, b = min(i, j), max(i, j)
    return a * (2 * n - a - 1) // 2 + b


@scalar
def row_of(at, j, n):
    """Row of a source: j from `at` on, or of a packed symmetric matrix (n, n) the entry (at, j)."""
    return packed(at, j, n) if n else at + j


@kernel
def combine(matrix, i, source, at, n, begin, first, start, out):
    """out = start + sum over the terms of row i of entry times source[row_of(at, column, n)].

    Of the source the systems from `begin` on, of the slabs those from `first` on. Several terms
    at once: a pass costs as much as what it loads and stores.
    """
    columns, weights, places, ends, slabs = matrix
    end, last = begin + out.size, first + out.size
    for t in range(0, ends[i, 0], 4):
        w0, w1, w2, w3 = weights[i, t], weights[i, t + 1], weights[i, t + 2], weights[i, t + 3]
        row_0 = source[row_of(at, columns[i, t], n), begin:end]
        row_1 = source[row_of(at, columns[i, t + 1], n), begin:end]
        row_2 = source[row_of(at, columns[i, t + 2], n), begin:end]
        row_3 = source[row_of(at, columns[i, t + 3], n), begin:end]
        if t == 0:
            for s in range(out.size):
                out[s] = start + (w0 * row_0[s] + w1 * row_1[s] + w2 * row_2[s] + w3 * row_3[s])
        else:
            for s in range(out.size):
                out[s] += w0 * row_0[s] + w1 * row_1[s] + w2 * row_2[s] + w3 * row_3[s]
    t, stop = ends[i, 0], ends[i, 1]
    if t == 0:
        out[:] = start
    while t + 1 < stop:
        entry, row = slabs[places[i, t], first:last], source[row_of(at, columns[i, t], n)]
        other, next_row = (
            slabs[places[i, t + 1], first:last],
            source[row_of(at, columns[i, t + 1], n)],
        )
        add_two(entry, row[begin:end], other, next_row[begin:end], out)
        t += 2
    if t < stop:
        entry, row = slabs[places[i, t], first:last], source[row_of(at, columns[i, t], n)]
        row = row[begin:end]
        for s in range(out.size):
            out[s] += entry[s] * row[s]


@kernel
def add_two(a, x, b, y, out):
    """out += a x, then b y."""
    for s in range(out.size):
        out[s] = (out[s] + a[s] * x[s]) + b[s] * y[s]


@kernel
def product(matrix, x, start, out):
    """out = matrix x + start, (m, systems) of x (n, systems); start (m,)."""
    m, systems = out.shape
    for first in range(0, systems, PART):
        last = min(first + PART, systems)
        for i in range(m):
            row = out[i, first:last]
            combine(matrix, i, x, 0, 0, first, first, start[i], row)


@kernel
def predict_covariance(matrix, sigma, noise, moved, out):
    """out = A sigma A' + noise, (5); noise packed too; moved (n, PART): scratch, a row of A sigma.

    Of an A that is the same for all systems, `product` does it with the matrix that takes sigma
    to A sigma A'.
    """
    n, systems = len(moved), sigma.shape[1]
    for first in range(0, systems, PART):
        size = min(PART, systems - first)
        for i in range(n):
            for column in range(n):
                combine(matrix, i, sigma, column, n, first, first, 0.0, moved[column, :size])
            for j in range(i, n):
                place = packed(i, j, n)
                combine(
                    matrix, j, moved, 0, 0, 0, first, noise[place], out[place, first : first + size]
                )


@kernel
def innovate(matrix, sigma, noise, values, rows, precisions, likelihood, s):
    """Decorrelate an innovation: S = C sigma C' + noise = L D L', L unit lower.

    values (m, systems) is e and becomes L^-1 e. Writes rows (m n, systems) = L^-1 C sigma,
    precisions (m, systems) = 1 / D, and log N(e; 0, S) without m log(2 pi) / 2. s (m + 1, m,
    PART): scratch.
    """
    m, systems = values.shape
    n = len(rows) // m
    for first in range(0, systems, PART):
        size = min(PART, systems - first)
        last = first + size
        for i in range(m):
            for column in range(n):
                row = rows[i * n + column, first:last]
                combine(matrix, i, sigma, column, n, first, first, 0.0, row)
        for i in range(m):
            for j in range(i, m):
                combine(matrix, i, rows, j * n, 0, first, first, noise[j, i], s[j, i, :size])
        of_systems = likelihood[first:last]
        of_systems[:] = 0.0
        for i in range(m):
            variance, value = s[i, i, :size], values[i, first:last]
            precision, factor = precisions[i, first:last], s[m, 0, :size]
            for k in range(size):
                precision[k] = 1.0 / variance[k]
                of_systems[k] -= 0.5 * (log(variance[k]) + value[k] * value[k] * precision[k])
            for j in range(i + 1, m):
                below = s[j, i, :size]
                for k in range(size):
                    factor[k] = below[k] * precision[k]
                for column in range(n):
                    row = rows[i * n + column, first:last]
                    subtract(factor, row, rows[j * n + column, first:last])
                subtract(factor, value, values[j, first:last])
                for other in range(i + 1, j + 1):
                    subtract(factor, s[other, i, :size], s[j, other, :size])


@kernel
def subtract(factor, row, out):
    """out -= factor times row."""
    for k in range(out.size):
        out[k] -= factor[k] * row[k]


@kernel
def correct(rows, precisions, values, weight, estimate, sigma, scratch):
    """estimate + g K e and sigma - g K C sigma (4), g = weight (systems,); scratch (4, PART).

    Of an innovation as `innovate` leaves it. g = 0 changes nothing.
    """
    systems = values.shape[1]
    for first in range(0, systems, PART):
        last = min(first + PART, systems)
        correct_part(
            rows, precisions, values, weight[first:last], estimate, sigma, first, last, scratch
        )


@kernel
def correct_part(rows, precisions, values, weight, estimate, sigma, first, last, scratch):
    """`correct` of the systems from first to last, with their weights; two values at a time."""
    m, n = len(values), len(estimate)
    share, next_share = scratch[0, : weight.size], scratch[1, : weight.size]
    gain, next_gain = scratch[2, : weight.size], scratch[3, : weight.size]
    for i in range(0, m, 2):
        precision, value = precisions[i, first:last], values[i, first:last]
        for k in range(weight.size):
            share[k] = weight[k] * precision[k]
        if i + 1 < m:
            precision, next_value = precisions[i + 1, first:last], values[i + 1, first:last]
            for k in range(weight.size):
                next_share[k] = weight[k] * precision[k]
        place = 0
        for a in range(n):
            of_a, state = rows[i * n + a, first:last], estimate[a, first:last]
            for k in range(weight.size):
                gain[k] = of_a[k] * share[k]
                state[k] += gain[k] * value[k]
            if i + 1 < m:
                of_a = rows[(i + 1) * n + a, first:last]
                for k in range(weight.size):
                    next_gain[k] = of_a[k] * next_share[k]
                    state[k] += next_gain[k] * next_value[k]
                for b in range(a, n):
                    of_b, next_of_b = rows[i * n + b, first:last], rows[(i + 1) * n + b, first:last]
                    subtract_two(gain, of_b, next_gain, next_of_b, sigma[place, first:last])
                    place += 1
            else:
                for b in range(a, n):
                    subtract(gain, rows[i * n + b, first:last], sigma[place, first:last])
                    place += 1


@kernel
def subtract_two(a, x, b, y, out):
    """out -= a x, then b y."""
    for k in range(out.size):
        out[k] = (out[k] - a[k] * x[k]) - b[k] * y[k]


@kernel
def add_spread(rows, precisions, values, weight, sigma, corrections):
    """sigma + g (1 - g) K e e' K', the spread of the means with and without the measurement (13).

    corrections (n, PART): scratch.
    """
    m, systems = values.shape
    n = len(corrections)
    for first in range(0, systems, PART):
        last = min(first + PART, systems)
        for a in range(n):
            correction = corrections[a, : last - first]  # K e
            correction[:] = 0.0
            for i in range(m):
                of_a = rows[i * n + a, first:last]
                precision, value = precisions[i, first:last], values[i, first:last]
                for k in range(correction.size):
                    correction[k] += of_a[k] * (value[k] * precision[k])
        of_weight = weight[first:last]
        for a in range(n):
            for b in range(a, n):
                one, other = corrections[a], corrections[b]
                entry = sigma[packed(a, b, n), first:last]
                for k in range(entry.size):
                    spread = of_weight[k] * (1.0 - of_weight[k])
                    entry[k] += spread * one[k] * other[k]


@kernel
def factorise(noise, factors, variances):
    """noise = L D L' of one matrix (m, m): its L, unit lower, and the diagonal of D, (m,)."""
    m = len(noise)
    for j in range(m):
        for i in range(j, m):
            entry = noise[i, j]
            for k in range(j):
                entry -= factors[i, k] * factors[j, k] * variances[k]
            if i == j:
                variances[j] = entry
            factors[i, j] = entry / variances[j]


@kernel
def noise_likelihood(received, factors, variances, out):
    """log N(y; 0, L D L') without m log(2 pi) / 2, of each y in received (systems, m).

    received becomes L^-1 y.
    """
    systems, m = received.shape
    constant = 0.0
    for i in range(m):
        constant += log(variances[i])
    for k in range(systems):
        total = constant
        for i in range(m):
            for j in range(i):
                received[k, i] -= factors[i, j] * received[k, j]
            total += received[k, i] * received[k, i] / variances[i]
        out[k] = -0.5 * total
