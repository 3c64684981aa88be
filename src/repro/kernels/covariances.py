"""Covariances of weighted particles, and errors measured by a covariance."""

import numpy as np

from repro.kernels.compiled import kernel

COLLAPSED = 1e12  # an error of a million claimed deviations: only particles that are one say so


@kernel
def of_particles(particles, weights, mean, components, out):
    """Weighted covariance of some components, out (trials, d, d), about the weighted mean.

    particles (trials, n, particles), weights (trials, particles), mean (trials, n),
    components (d,).
    """
    for trial in range(len(out)):
        weight = weights[trial]
        for a in range(components.size):
            i = components[a]
            of_a, centre_a = particles[trial, i], mean[trial, i]
            for b in range(a + 1):
                j = components[b]
                of_b, centre_b = particles[trial, j], mean[trial, j]
                total = 0.0
                for p in range(weight.size):
                    total += weight[p] * (of_a[p] - centre_a) * (of_b[p] - centre_b)
                out[trial, a, b] = out[trial, b, a] = total


@kernel
def normalised_errors(error, covariance, factors, out):
    """e' P^-1 e of each system, (systems,): error (systems, d), covariance (systems, d, d).

    P = L D L', L unit lower; factors (d, d + 1): scratch, L and L^-1 e. A direction in which P has
    no variance, but for rounding, counts nothing without an error, and infinitely with one.
    """
    systems, d = error.shape
    for s in range(systems):
        out[s] = 0.0
        for i in range(d):
            value, variance = error[s, i], covariance[s, i, i]
            for j in range(i):
                entry = covariance[s, i, j]
                for m in range(j):
                    entry -= factors[i, m] * factors[j, m] * factors[m, m]
                factors[i, j] = entry / factors[j, j] if factors[j, j] > 0.0 else 0.0
                value -= factors[i, j] * factors[j, d]
                variance -= factors[i, j] * factors[i, j] * factors[j, j]
            factors[i, i], factors[i, d] = variance, value
            if variance > 0.0:
                out[s] += value * value / variance
            elif value != 0.0:
                out[s] = np.inf
        if out[s] > COLLAPSED:
            out[s] = np.inf
