"""Steps of the particle filters of randomly coupled targets [censored_network Algorithm 1].

One kernel a filter, in the order of the algorithm, one trial and one target (node) after another.
Particles are (trials, nodes, 3, particles), weights (trials, nodes, particles), means (trials,
nodes, 3). Within a node each loop over the particles does one thing, so that it is vectorised.

What a step needs besides is in tuples:
motion   speed (nodes,), turn rate, deviations of the process noise (3,), coupling (nodes, nodes),
         coupling rate, whether each particle draws its coupling
network  sensors (M, b, 2), strength at a distance of one, its slope over log(distance^2),
         noise: weight and reciprocal deviation of either component
reading  low and high (trials, nodes, b), group probabilities (trials, nodes, M); the receiver knows
         that a reading is between low and high, and exactly where they are equal
cloud    particles, weights, means, effective sample sizes (trials,), degenerate updates (trials,)
scratch  parents (particles,) int64, random numbers (`drawn_length`,), rows (ROWS, particles)
"""

import numpy as np

from repro.kernels import compiled_resampling as resampling
from repro.kernels import random
from repro.kernels.compiled import kernel, scalar
from repro.kernels.elementary import (
    exp,
    expm1,
    log,
    log_normal_cdf,
    log_of_normal,
    logaddexp,
    sin,
    sine_cosine,
)
from repro.kernels.sensor_network_step import UNDERFLOWS, draw_parents, take, weighted_mean

# Distances are clipped to 1e-9 ... 1e9 m, so that every signal strength is finite.
NEAREST_SQUARED, FARTHEST_SQUARED = 1e-18, 1e18  # m^2
ROWS = 10  # of the scratch
ROOT_TWO_PI = 2.5066282746310002


def drawn_length(count: int) -> int:
    """How many random numbers a node has room for: three normals and a uniform a particle."""
    return 4 * count + 8


@kernel
def auxiliary(keys, k, reading, motion, network, scheme, before, after, scratch):
    """Step k with the weights (22); counts the draws that nothing explains, of both stages."""
    particles_before, weights_before, mean_before, _, _ = before
    particles, weights, mean, effective, degenerate = after
    parents, drawn, rows = scratch
    moved, eta, work = rows[:3], rows[3:6], rows[6:8]
    first, chosen_first = rows[8], rows[9]
    nodes = particles.shape[1]
    for trial in range(keys.size):
        effective[trial] = 0.0
        for node in range(nodes):
            key, turn = keys[trial], k * nodes + node
            x, w, w_before = (
                particles[trial, node],
                weights[trial, node],
                weights_before[trial, node],
            )
            known = of_node(reading, trial, node)
            drift(particles_before[trial, node], node, motion, moved)
            # Intermediate particles eta; an index has a probability proportional to w p(y | eta)
            purposes = random.FIRST_STAGE, random.FIRST_COUPLING
            mixture(moved, mean_before[trial], node, motion, key, turn, purposes, drawn, eta)
            likelihood(eta, known, network, w_before, work, first)
            for j in range(w.size):
                w[j] = w_before[j] * first[j]
            if resampling.normalise(w):  # no first stage to divide by
                degenerate[trial] += 1.0
                first[:] = 1.0
            draw_parents(w, scheme, key, turn, drawn, parents)
            # A fresh draw from each chosen parent, weighted by p(y | x) / p(y | eta of the parent)
            take(moved, parents, eta)
            purposes = random.MOTION, random.COUPLING
            mixture(eta, mean_before[trial], node, motion, key, turn, purposes, drawn, x)
            for j in range(w.size):
                chosen_first[j] = first[parents[j]]
            for j in range(w.size):
                chosen_first[j] = 1.0 / chosen_first[j]
            likelihood(x, known, network, chosen_first, work, w)
            for j in range(w.size):
                w[j] *= chosen_first[j]
            degenerate[trial] += resampling.normalise(w)
            weighted_mean(x, w, mean[trial, node])
            effective[trial] += resampling.effective_sample_size(w) / nodes


@kernel
def bootstrap(keys, k, reading, motion, network, scheme, before, after, scratch):
    """Step k with standard resampling; the estimate is that before the next resampling."""
    particles_before, weights_before, mean_before, _, _ = before
    particles, weights, mean, effective, degenerate = after
    parents, drawn, rows = scratch
    moved, chosen, work, equal = rows[:3], rows[3:6], rows[6:8], rows[8]
    nodes = particles.shape[1]
    equal[:] = 1.0
    for trial in range(keys.size):
        effective[trial] = 0.0
        for node in range(nodes):
            key, turn = keys[trial], k * nodes + node
            x, w = particles[trial, node], weights[trial, node]
            draw_parents(weights_before[trial, node], scheme, key, turn, drawn, parents)
            take(particles_before[trial, node], parents, chosen)
            drift(chosen, node, motion, moved)
            purposes = random.MOTION, random.COUPLING
            mixture(moved, mean_before[trial], node, motion, key, turn, purposes, drawn, x)
            likelihood(x, of_node(reading, trial, node), network, equal, work, w)
            degenerate[trial] += resampling.normalise(w)
            weighted_mean(x, w, mean[trial, node])
            effective[trial] += resampling.effective_sample_size(w) / nodes


@kernel
def dead_reckoning(keys, k, motion, before, after, scratch):
    """Step k without a measurement: the weights stay as they are."""
    particles_before, _, mean_before, _, _ = before
    particles, weights, mean, _, _ = after
    _, drawn, rows = scratch
    nodes = particles.shape[1]
    for trial in range(keys.size):
        for node in range(nodes):
            key, turn = keys[trial], k * nodes + node
            drift(particles_before[trial, node], node, motion, rows[:3])
            purposes, x = (random.MOTION, random.COUPLING), particles[trial, node]
            mixture(rows[:3], mean_before[trial], node, motion, key, turn, purposes, drawn, x)
            weighted_mean(x, weights[trial, node], mean[trial, node])


@kernel
def likelihoods(particles, reading, network, rows, out):
    """(14), (21) of all particles, up to a factor a node, (trials, nodes, particles)."""
    rows[0, :] = 1.0
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
def drift(x, node, motion, moved):
    """f(x) of (23): one step of an uncoupled target without noise."""
    speed, turn_rate, _, _, _, _ = motion
    px, py, phi = x[0], x[1], x[2]
    moved_px, moved_py, moved_phi = moved[0], moved[1], moved[2]
    along = speed[node]
    for j in range(phi.size):
        sine, cosine = sine_cosine(phi[j])
        moved_px[j] = px[j] + along * cosine
        moved_py[j] = py[j] + along * sine
        moved_phi[j] = phi[j] + turn_rate


@kernel
def mixture(moved, means, node, motion, key, turn, purposes, drawn, x):
    """Draw x of (12) from f(x), coupled to the estimates (nodes, 3) of the step before."""
    _, _, deviation, coupling, rate, per_particle = motion
    for_noise, for_coupling = purposes
    count = x.shape[1]
    normals = drawn[: random.padded(3 * count)]
    random.fill_normals(key, turn, for_noise, normals)
    uniforms = drawn[normals.size : normals.size + random.padded(count)]
    if per_particle:
        random.fill_uniforms(key, turn, for_coupling, uniforms)
    else:
        uniforms[:] = random.uniform(key, turn, for_coupling)
    for component in range(3):
        push = 0.0
        for other in range(len(means)):
            push += coupling[node, other] * sin(means[other, component])
        spread, first = deviation[component], component * count
        source, noise, drawn_x = moved[component], normals[first : first + count], x[component]
        for j in range(count):
            coupled = push if uniforms[j] < rate else 0.0
            drawn_x[j] = source[j] + spread * noise[j] + coupled


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
    if resampling.weighted_total(prior, out) < UNDERFLOWS:
        log_likelihood(x, known, network, work, out)
        largest = -np.inf
        for j in range(out.size):
            largest = out[j] if prior[j] > 0.0 and out[j] > largest else largest
        for j in range(out.size):
            out[j] = exp(out[j] - largest) if prior[j] > 0.0 else 0.0


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
        product[j] *= peak_1 * exp(scale_1 * square) + peak_2 * exp(scale_2 * square)


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
    division for two of them it takes a third of the time of `elementary.normal_cdf`.
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
    return exp(-0.5 * a * a) * p, q


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
