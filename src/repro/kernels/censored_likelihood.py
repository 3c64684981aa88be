"""Likelihood of censored readings of signal strengths [censored_network Propositions 1 and 2].

What a receiver knows is in two tuples:
reading  low and high (trials, nodes, b), group probabilities (trials, nodes, M): a reading is
         between low and high, and known exactly where they are equal
network  sensors (M, b, 2), strength at a distance of one, its slope over log(distance^2),
         noise: weight and reciprocal deviation of either component

Each loop over the particles does one thing, so that it is vectorised.
"""

import numpy as np

from repro.kernels import resampling
from repro.kernels.compiled import kernel, scalar
from repro.kernels.elementary import (
    exp_of_negative,
    expm1,
    log,
    log_of_normal,
    logaddexp,
)
from repro.kernels.normal_probability import log_normal_cdf

# Distances are clipped to 1e-9 ... 1e9 m, so that every signal strength is finite.
NEAREST_SQUARED, FARTHEST_SQUARED = 1e-18, 1e18  # m^2
ROOT_TWO_PI = 2.5066282746310002


@kernel
def likelihoods(particles, reading, network, rows, out):
    """(14), (21) of all particles, up to a factor a node, (trials, nodes, particles)."""
    rows[0, :] = 1.0  # rows (3, particles) of scratch
    for trial in range(len(particles)):
        for node in range(particles.shape[1]):
            known = of_node(reading, trial, node)
            likelihood(particles[trial, node], known, network, rows[0], rows[1:], out[trial, node])


@kernel
def of_node(reading, trial, node):
    """What one node receives: low (b,), high (b,) and group probabilities (M,)."""
    low, high, probability = reading
    return low[trial, node], high[trial, node], probability[trial, node]


@kernel
def likelihood(x, known, network, prior, work, out):
    """p(y | x) (14), (21) of each particle, up to a factor.

    In logarithms only where the weights that it gives, `prior` times it, would underflow. Then it
    is relative to the largest with a positive prior, and NaN if that is zero.
    """
    low, high, probability = known
    sensors, at_one, slope, noise = network
    strength, of_group = work[0], work[1]
    out[:] = 0.0
    for m in range(len(sensors)):  # each group is compared with the same readings
        of_group[:] = probability[m]
        for i in range(low.size):
            strengths(x, sensors[m, i], at_one, slope, strength)
            if low[i] == high[i]:
                density(strength, low[i], noise, of_group)
            elif low[i] == -np.inf:
                below(strength, high[i], noise, of_group)
            elif high[i] == np.inf:
                above(strength, low[i], noise, of_group)
            else:
                between(strength, low[i], high[i], noise, of_group)
        for j in range(out.size):
            out[j] += of_group[j]
    if resampling.weighted_total(prior, out) < resampling.UNDERFLOWS:
        log_likelihood(x, known, network, work, out)
        largest = -np.inf
        for j in range(out.size):
            largest = out[j] if prior[j] > 0.0 and out[j] > largest else largest
        for j in range(out.size):
            out[j] = exp_of_negative(out[j] - largest) if prior[j] > 0.0 else 0.0


@kernel
def strengths(x, sensor, at_one, slope, out):
    """h(x) of one sensor: (24) without noise."""
    px, py, sensor_px, sensor_py = x[0], x[1], sensor[0], sensor[1]
    for j in range(out.size):
        across, along = px[j] - sensor_px, py[j] - sensor_py
        squared = across * across + along * along
        squared = NEAREST_SQUARED if squared < NEAREST_SQUARED else squared
        squared = FARTHEST_SQUARED if squared > FARTHEST_SQUARED else squared
        out[j] = at_one + slope * log_of_normal(squared)


@kernel
def density(strength, y, noise, product):
    """Multiply by the density of an exact reading (25)."""
    p_1, inverse_1, p_2, inverse_2 = noise
    peak_1, peak_2 = p_1 * inverse_1 / ROOT_TWO_PI, p_2 * inverse_2 / ROOT_TWO_PI
    scale_1, scale_2 = -0.5 * inverse_1 * inverse_1, -0.5 * inverse_2 * inverse_2
    for j in range(strength.size):
        error = y - strength[j]
        square = error * error
        nominal = peak_1 * exp_of_negative(scale_1 * square)
        product[j] *= nominal + peak_2 * exp_of_negative(scale_2 * square)


@kernel
def below(strength, high, noise, product):
    """Multiply by the probability that a reading is below a threshold (17)."""
    for j in range(strength.size):
        product[j] *= cumulative(high - strength[j], noise)


@kernel
def above(strength, low, noise, product):
    """Multiply by the probability that a reading is above a threshold: the noise is symmetric."""
    for j in range(strength.size):
        product[j] *= cumulative(strength[j] - low, noise)


@kernel
def between(strength, low, high, noise, product):
    """Multiply by the probability that a reading is between two thresholds (14)."""
    for j in range(strength.size):
        a, b = low - strength[j], high - strength[j]
        flip = a + b > 0.0  # in the tail in which the difference loses no digits
        product[j] *= cumulative(-a if flip else b, noise) - cumulative(-b if flip else a, noise)


@scalar
def cumulative(t, noise):
    """F(t) of (25), and the probability of either tail within 1e-12 of itself."""
    p_1, inverse_1, p_2, inverse_2 = noise
    over_1, under_1 = tail(abs(t) * inverse_1)
    over_2, under_2 = tail(abs(t) * inverse_2)
    beyond = (p_1 * over_1 * under_2 + p_2 * over_2 * under_1) / (under_1 * under_2)
    return 1.0 - beyond if t > 0.0 else beyond


@scalar
def tail(a):
    """Standard normal probability beyond a >= 0, as numerator and denominator.

    The rational function is the best of its degrees for e^(a^2 / 2) times the probability. With a
    division for two of them it takes a third of the time of `normal_probability.normal_cdf`.
    """
    a = 40.0 if a > 40.0 else a  # beyond, it is zero
    p = 0.3989422804007282 * a + 7.250628874474303
    p = p * a + 64.62603058708429
    p = p * a + 356.99872898960126
    p = p * a + 1307.2831829655354
    p = p * a + 3170.322908897444
    p = p * a + 4752.974137552448
    p = p * a + 3484.2660328009983
    q = a + 18.174631344207647
    q = q * a + 162.99343582498622
    q = q * a + 913.0377162884331
    q = q * a + 3436.8674533064336
    q = q * a + 8805.3069127566
    q = q * a + 14877.334458013405
    q = q * a + 15066.032421158594
    q = q * a + 6968.532065606153
    return exp_of_negative(-0.5 * a * a) * p, q


@kernel
def log_likelihood(x, known, network, work, out):
    """Logarithm of p(y | x); slow, as hardly ever needed."""
    low, high, probability = known
    sensors, at_one, slope, noise = network
    strength, of_group = work[0], work[1]
    out[:] = -np.inf
    for m in range(len(sensors)):
        of_group[:] = log(probability[m])
        for i in range(low.size):
            strengths(x, sensors[m, i], at_one, slope, strength)
            for j in range(out.size):
                of_group[j] += log_of_reading(low[i] - strength[j], high[i] - strength[j], noise)
        for j in range(out.size):
            out[j] = logaddexp(out[j], of_group[j])


@kernel
def log_of_reading(a, b, noise):
    """Log density of the noise at a = b, else log probability between."""
    p_1, inverse_1, p_2, inverse_2 = noise
    if a == b:
        first, second = a * inverse_1, a * inverse_2
        return logaddexp(
            log(p_1 * inverse_1 / ROOT_TWO_PI) - 0.5 * first * first,
            log(p_2 * inverse_2 / ROOT_TWO_PI) - 0.5 * second * second,
        )
    if a + b > 0.0:
        a, b = -b, -a
    upper, lower = log_cumulative(b, noise), log_cumulative(a, noise)
    return upper + log(-expm1(lower - upper))


@kernel
def log_cumulative(t, noise):
    """log F(t)."""
    p_1, inverse_1, p_2, inverse_2 = noise
    return logaddexp(
        log(p_1) + log_normal_cdf(t * inverse_1), log(p_2) + log_normal_cdf(t * inverse_2)
    )
