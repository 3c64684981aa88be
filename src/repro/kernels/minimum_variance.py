"""Steps of OMVF [packet_delays (6), (13)-(17)] and EMVF [packet_delays (22)-(27)].

The received y(k+1) is a scalar: z(k+1-i) with the mean weight alpha_i. `known` is what a filter
knows of plant and network: the weights alpha_i (N + 1,), the sign of the terms i >= 2 of Qbar (+1
as printed), Q (n, n), R, and whether the reading `matched` holds. Of one system
rows         C(k+1), C(k), C(k-1) ..., (terms, n), of the terms that exist
transitions  A(k), A(k-1), ..., (at least terms - 1, n, n)
referred     written: the rows J_i, then J of (16), (terms + 1, n)
scratch      (n, n) and (n, n + 1)
"""

import numpy as np

from repro.kernels.compiled import kernel


@kernel
def omvf(
    rows,
    transitions,
    known,
    covariance,
    moment,
    estimate,
    received,
    next_covariance,
    next_moment,
    next_estimate,
    gain,
    referred,
    scratch,
):
    """One gain for all trials; estimates (trials, n), received (trials,)."""
    states = covariance, moment, next_covariance, next_moment
    update(rows, transitions, known, 0.0, states, gain, referred, scratch)
    a, row = transitions[0], referred[len(rows)]
    for trial in range(len(estimate)):
        for i in range(gain.size):
            total = gain[i] * received[trial]
            for j in range(gain.size):
                total += (a[i, j] - gain[i] * row[j]) * estimate[trial, j]  # F of (13)
            next_estimate[trial, i] = total  # (6)


@kernel
def emvf(
    rows,
    transitions,
    known,
    spread,
    covariance,
    moment,
    predicted,
    innovation,
    next_covariance,
    next_moment,
    next_estimate,
    degenerate,
    gain,
    referred,
    scratch,
):
    """A gain for each trial; all arrays but the scratch have a leading axis of trials.

    spread (trials,) is the variance of h over the delays, used if `matched`. Adds to degenerate
    (trials,) where the correction would be none or not finite.
    """
    for trial in range(innovation.size):
        states = covariance[trial], moment[trial], next_covariance[trial], next_moment[trial]
        update(
            rows[trial], transitions[trial], known, spread[trial], states, gain, referred, scratch
        )
        largest = total = 0.0
        for i in range(gain.size):
            largest = max(largest, abs(gain[i]))
            total += abs(gain[i] * innovation[trial])
        usable = largest > 0.0 and total < np.inf
        degenerate[trial] += not usable
        for i in range(gain.size):
            correction = gain[i] * innovation[trial] if usable else 0.0
            next_estimate[trial, i] = predicted[trial, i] + correction  # (22)


@kernel
def update(rows, transitions, known, spread, states, gain, referred, scratch):
    """Gain K (n,), covariance and second moment of step k+1 from P(k|k) and S(k).

    If the variance is not positive or the gain not finite, the gain is 0: no update.
    """
    weights, sign, q, r, matched = known
    covariance, moment, next_covariance, next_moment = states
    product, elimination = scratch
    terms, n = rows.shape
    a, row = transitions[0], referred[terms]
    qbar = refer(rows, transitions, weights, sign, q, referred, elimination)
    for j in range(n):
        row[j] = 0.0
        for i in range(terms):
            row[j] += weights[i] * referred[i, j]  # (16)
    share = uncertainty = 0.0
    for i in range(terms):
        share += weights[i]
    if matched:
        for i in range(terms):
            uncertainty += weights[i] * quadratic(referred[i], covariance)
    else:
        # Sbar - J S J' at once: the two cancel to a small difference of terms as large as S.
        uncertainty, spread = quadratic(row, covariance), 0.0
        for i in range(terms):
            spread += weights[i] * quadratic(referred[i], moment)
        spread = max(spread - quadratic(row, moment), 0.0)
    # With N = 0 there is noise whether or not the packet arrives: Rbar = R, not p R.
    rbar = r * (share if weights.size > 1 else 1.0)
    variance = uncertainty + spread + qbar + rbar
    propagate(a, covariance, q, product, next_covariance)
    usable = variance > 0.0
    for i in range(n):
        gain[i] = 0.0  # A P J' + alpha_0 Q C', with A P in `product`
        for j in range(n):
            gain[i] += product[i, j] * row[j] + weights[0] * q[i, j] * rows[0, j]
        gain[i] /= variance  # (14)
        usable = usable and abs(gain[i]) < np.inf
    variance = variance if usable else 0.0
    for i in range(n):
        gain[i] = gain[i] if usable else 0.0
    for i in range(n):  # (15), (25), which with (14) are A P A' + Q - K variance K'
        for j in range(n):
            next_covariance[i, j] -= variance * gain[i] * gain[j]
    propagate(a, moment, q, product, next_moment)  # (17), (27)


@kernel
def refer(rows, transitions, weights, sign, q, referred, elimination):
    """The rows J_i of (16), which express z(k+1-i) by x(k); returns Qbar."""
    terms, n = rows.shape
    for j in range(n):
        referred[0, j] = 0.0
        for i in range(n):
            referred[0, j] += rows[0, i] * transitions[0, i, j]
    qbar = weights[0] * quadratic(rows[0], q)
    for i in range(1, terms):
        for j in range(n):
            referred[i, j] = rows[i, j]
        for j in range(i - 1, 0, -1):  # A(k+1-i)^-1 first, A(k-1)^-1 last, by (18)
            divide(referred[i], transitions[j], elimination)
            qbar += sign * weights[i] * quadratic(referred[i], q)
    return qbar


@kernel
def quadratic(row, matrix):
    """row matrix row'."""
    total = 0.0
    for i in range(row.size):
        if row[i] != 0.0:
            for j in range(row.size):
                total += row[i] * matrix[i, j] * row[j]
    return total


@kernel
def propagate(a, symmetric, q, product, out):
    """A M A' + Q of a symmetric M; product: A M."""
    n = len(a)
    for i in range(n):
        for j in range(n):
            product[i, j] = 0.0
        for m in range(n):
            if a[i, m] != 0.0:
                for j in range(n):
                    product[i, j] += a[i, m] * symmetric[m, j]
    for i in range(n):
        for j in range(i + 1):
            total = q[i, j]
            for m in range(n):
                total += product[i, m] * a[j, m]
            out[i, j] = out[j, i] = total


@kernel
def divide(row, matrix, work):
    """row <- row A^-1: elimination of A' with partial pivoting, work (n, n + 1)."""
    n = row.size
    for i in range(n):
        for j in range(n):
            work[i, j] = matrix[j, i]
        work[i, n] = row[i]
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
        row[i] = work[i, n]
        for j in range(i + 1, n):
            row[i] -= work[i, j] * row[j]
        row[i] /= work[i, i]
