"""Steps of linear filters of a scalar y(k) = h(k) X(k) + v(k) whose row h(k) is one of several.

X(k+1) = Phi X(k) + noise, Phi and the covariance of the noise (n, n), rows (m, n), R the variance
of v(k). Estimates are (trials, n), received (trials,); scratch: Phi P (n, n), a row, a vector.
"""

from repro.kernels.compiled import kernel
from repro.kernels.small_matrices import propagate, quadratic


@kernel
def unknown_row(
    dynamics,
    rows,
    weights,
    r,
    covariance,
    moment,
    estimate,
    received,
    next_covariance,
    next_moment,
    next_estimate,
    scratch,
):
    """The linear minimum mean square error filter where rows[i] measures with weights[i].

    The rows of the steps are independent. Covariance and second moment E[X X'], (n, n), are the
    same for every trial.
    """
    transition, noise = dynamics
    product, row, cross = scratch
    propagate(transition, covariance, noise, product, next_covariance)
    propagate(transition, moment, noise, product, next_moment)
    for j in range(row.size):  # E h
        row[j] = 0.0
        for i in range(weights.size):
            row[j] += weights[i] * rows[i, j]
    spread = -quadratic(row, next_moment)  # of h X over the rows
    for i in range(weights.size):
        spread += weights[i] * quadratic(rows[i], next_moment)
    scale = 1.0 / (measured(row, next_covariance, cross) + spread + r)
    lessen(next_covariance, cross, scale)
    for trial in range(len(estimate)):
        correct(
            transition, estimate[trial], row, cross, scale, received[trial], next_estimate[trial]
        )


@kernel
def known_row(
    dynamics,
    rows,
    which,
    r,
    least_variance,
    covariance,
    estimate,
    received,
    next_covariance,
    next_estimate,
    scratch,
):
    """The Kalman filter of the row rows[which], which (trials,); covariances (trials, n, n).

    No update where the variance of y(k) is not above the least: what is received is then known.
    """
    transition, noise = dynamics
    product, _, cross = scratch
    for trial in range(len(estimate)):
        row = rows[which[trial]]
        propagate(transition, covariance[trial], noise, product, next_covariance[trial])
        variance = measured(row, next_covariance[trial], cross) + r
        scale = 1.0 / variance if variance > least_variance else 0.0
        lessen(next_covariance[trial], cross, scale)
        correct(
            transition, estimate[trial], row, cross, scale, received[trial], next_estimate[trial]
        )


@kernel
def measured(row, covariance, cross):
    """The variance of row X; writes its covariance with X."""
    variance = 0.0
    for i in range(row.size):
        cross[i] = 0.0
        for j in range(row.size):
            cross[i] += covariance[i, j] * row[j]
        variance += row[i] * cross[i]
    return variance


@kernel
def lessen(covariance, cross, scale):
    """Subtract scale cross cross'."""
    for i in range(cross.size):
        for j in range(cross.size):
            covariance[i, j] -= scale * cross[i] * cross[j]


@kernel
def correct(transition, estimate, row, cross, scale, received, out):
    """Prediction plus gain, scale cross, times innovation."""
    expected = 0.0
    for i in range(row.size):
        out[i] = 0.0
        for j in range(row.size):
            out[i] += transition[i, j] * estimate[j]
        expected += row[i] * out[i]
    for i in range(row.size):
        out[i] += scale * cross[i] * (received - expected)


@kernel
def propagated(dynamics, symmetric, product, out):
    """Phi M Phi' + noise, for callers in plain NumPy."""
    transition, noise = dynamics
    propagate(transition, symmetric, noise, product, out)
