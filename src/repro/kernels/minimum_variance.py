"""Steps of OMVF [packet_delays (6), (13)-(17)] and EMVF [packet_delays (22)-(27)].

The received y(k+1) is a scalar: z(k+1-i) with the mean weight alpha_i. `known` is what a filter
knows of plant and network: the weights alpha_i (N + 1,), the sign of the terms i >= 2 of Qbar (+1
as printed), Q (n, n), R, and whether the reading `matched` holds. Systems, one of the linear
filter and one for each trial of the other, are the last axis, over which the loops are vectorised:
rows         C(k+1), C(k), C(k-1) ..., (terms, n, systems), of the terms that exist
transitions  A(k), A(k-1), ..., (at least terms - 1, n, n, systems)
states       P(k|k), S(k), and written those of k+1, (n, n, systems) each
spread       variance of h over the delays, (systems,): given if `matched`, else written
gain         K (n, systems), written; 0 where it would not be finite: no update
referred     written: the rows J_i, then J of (16), (terms + 1, n, systems)
scratch      (n, n, systems), (n + 1, systems), (systems,), and (n, n + 1) of a single system
"""

import numpy as np

from repro.kernels.compiled import kernel


@kernel
def omvf(rows, transitions, known, states, spread, gain, referred, scratch, estimate, y, after):
    """One gain for all trials; estimates (trials, n) before and after, y (trials,)."""
    update(rows, transitions, known, states, spread, gain, referred, scratch)
    a, row = transitions[0], referred[len(rows)]
    for trial in range(len(estimate)):
        for i in range(len(gain)):
            total = gain[i, 0] * y[trial]
            for j in range(len(gain)):
                total += (a[i, j, 0] - gain[i, 0] * row[j, 0]) * estimate[trial, j]  # F of (13)
            after[trial, i] = total  # (6)


@kernel
def emvf(
    rows,
    transitions,
    known,
    states,
    spread,
    gain,
    referred,
    scratch,
    predicted,
    innovation,
    after,
    degenerate,
):
    """A gain for each trial; estimates (n, trials), predicted and after.

    Adds to degenerate (trials,) where the correction would be none or not finite.
    """
    update(rows, transitions, known, states, spread, gain, referred, scratch)
    for trial in range(innovation.size):
        largest = total = 0.0
        for i in range(len(gain)):
            largest = max(largest, abs(gain[i, trial]))
            total += abs(gain[i, trial] * innovation[trial])
        usable = largest > 0.0 and total < np.inf
        degenerate[trial] += not usable
        for i in range(len(gain)):
            correction = gain[i, trial] * innovation[trial] if usable else 0.0
            after[i, trial] = predicted[i, trial] + correction  # (22)


@kernel
def update(rows, transitions, known, states, spread, gain, referred, scratch):
    """Gain, covariance and second moment of step k+1."""
    weights, sign, q, r, matched = known
    covariance, moment, next_covariance, next_moment = states
    product, column, variance, elimination = scratch
    terms, n, systems = rows.shape
    row = referred[terms]
    variance[:] = 0.0
    add_qbar(rows, transitions, weights, sign, q, referred, elimination, variance)
    row[:] = 0.0
    for i in range(terms):
        for j in range(n):
            add_scaled(weights[i], referred[i, j], row[j])  # (16)
    if matched:
        for i in range(terms):
            add_quadratic(weights[i], referred[i], covariance, column, variance)
    else:
        # Sbar - J S J' at once: the two cancel to a small difference of terms as large as S.
        add_quadratic(1.0, row, covariance, column, variance)
        spread[:] = 0.0
        for i in range(terms):
            add_quadratic(weights[i], referred[i], moment, column, spread)
        add_quadratic(-1.0, row, moment, column, spread)
    # With N = 0 there is noise whether or not the packet arrives: Rbar = R, not p R.
    share = 0.0
    for i in range(terms):
        share += weights[i]
    rbar = r * (share if weights.size > 1 else 1.0)
    propagate(transitions[0], covariance, q, product, next_covariance)
    for i in range(n):  # A P J' + alpha_0 Q C', with A P in `product`
        gain[i] = 0.0
        for j in range(n):
            add_product(1.0, product[i, j], row[j], gain[i])
            if q[i, j] != 0.0:
                add_scaled(weights[0] * q[i, j], rows[0, j], gain[i])
    for system in range(systems):
        total = variance[system] + max(spread[system], 0.0) + rbar
        size = 0.0
        for i in range(n):
            gain[i, system] /= total  # (14)
            size += abs(gain[i, system])
        usable = total > 0.0 and size < np.inf
        variance[system] = -total if usable else 0.0
        for i in range(n):
            gain[i, system] = gain[i, system] if usable else 0.0
    for i in range(n):  # (15), (25), which with (14) are A P A' + Q - K variance K'
        column[0] = 0.0
        add_product(1.0, variance, gain[i], column[0])
        for j in range(n):
            add_product(1.0, column[0], gain[j], next_covariance[i, j])
    propagate(transitions[0], moment, q, product, next_moment)  # (17), (27)


@kernel
def add_qbar(rows, transitions, weights, sign, q, referred, elimination, out):
    """The rows J_i of (16), which express z(k+1-i) by x(k); adds Qbar to out."""
    terms, n, systems = rows.shape
    referred[:] = 0.0
    for j in range(n):
        for i in range(n):
            add_product(1.0, rows[0, i], transitions[0, i, j], referred[0, j])
    add_noise(weights[0], rows[0], q, out)
    for i in range(1, terms):
        for j in range(n):
            add_scaled(1.0, rows[i, j], referred[i, j])
        for j in range(i - 1, 0, -1):  # A(k+1-i)^-1 first, A(k-1)^-1 last, by (18)
            for system in range(systems):
                divide(referred[i], transitions[j], system, elimination)
            add_noise(sign * weights[i], referred[i], q, out)


@kernel
def propagate(a, symmetric, q, product, out):
    """A M A' + Q of a symmetric M; product: A M. Entries of A that are all zero cost little."""
    n = len(a)
    product[:] = 0.0
    for i in range(n):
        for j in range(n):
            out[i, j] = q[i, j]
    for i in range(n):
        for m in range(n):
            if nonzero(a[i, m]) > 0:
                for j in range(n):
                    add_product(1.0, a[i, m], symmetric[m, j], product[i, j])
    for j in range(n):
        for m in range(n):
            if nonzero(a[j, m]) > 0:
                for i in range(j + 1):
                    add_product(1.0, product[i, m], a[j, m], out[i, j])
        for i in range(j):
            for system in range(out.shape[2]):
                out[j, i, system] = out[i, j, system]


@kernel
def nonzero(values):
    """How many values are not zero."""
    count = 0
    for value in values:
        count += value != 0.0
    return count


@kernel
def add_product(weight, left, right, out):
    """Add weight left right, (systems,) each."""
    for system in range(out.size):
        out[system] += weight * left[system] * right[system]


@kernel
def add_scaled(weight, values, out):
    """Add weight values, (systems,)."""
    for system in range(out.size):
        out[system] += weight * values[system]


@kernel
def add_quadratic(weight, row, matrix, column, out):
    """Add weight row matrix row' to out, in one term: equal terms must cancel to zero."""
    n = len(row)
    column[:] = 0.0
    for i in range(n):
        for j in range(n):
            add_product(1.0, matrix[i, j], row[j], column[i])
        add_product(1.0, row[i], column[i], column[n])
    add_scaled(weight, column[n], out)


@kernel
def add_noise(weight, row, q, out):
    """Add weight row Q row' to out."""
    for i in range(len(row)):
        for j in range(len(row)):
            if q[i, j] != 0.0:
                add_product(weight * q[i, j], row[i], row[j], out)


@kernel
def divide(row, matrix, system, work):
    """row <- row A^-1 of one system: elimination of A' with partial pivoting, work (n, n + 1)."""
    n = len(row)
    for i in range(n):
        for j in range(n):
            work[i, j] = matrix[j, i, system]
        work[i, n] = row[i, system]
    for i in range(n):
        pivot = i
        for j in range(i + 1, n):
            pivot = j if abs(work[j, i]) > abs(work[pivot, i]) else pivot
        for m in range(i, n + 1):
            work[i, m], work[pivot, m] = work[pivot, m], work[i, m]
        for j in range(i + 1, n):
            if work[j, i] != 0.0:
                factor = work[j, i] / work[i, i]
                for m in range(i + 1, n + 1):
                    work[j, m] -= factor * work[i, m]
    for i in range(n - 1, -1, -1):
        total = work[i, n]
        for j in range(i + 1, n):
            total -= work[i, j] * row[j, system]
        row[i, system] = total / work[i, i]
