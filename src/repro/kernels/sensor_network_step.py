"""Bootstrap steps with saturating, energy-harvesting sensors [energy_harvesting Algorithm 1].

One kernel a plant, in the order of the algorithm, one trial after another. Particles are
(trials, n, particles), weights (trials, particles), means (trials, n), measurements z (trials, N).
Within a trial each loop over the particles does one thing, so that it is vectorised.

What the filter knows of the sensors is in two arguments:
noise    (N + 1,): variances of Gaussian noise at the sensors, then of the channel; or the mean of
         exponential noise at each sensor, then a zero
network  lambda(k) of (26), the saturation probability gbar, the saturation level

Scratch of one trial: parents (particles,) int64; drawn (m,) random numbers, `drawn_length` of them;
levels (N, particles).
"""

import numpy as np

from repro.kernels import random, resampling
from repro.kernels import sensed_plants as plants
from repro.kernels.compiled import kernel, scalar
from repro.kernels.elementary import exp, log


def drawn_length(components: int, count: int) -> int:
    """How many random numbers a trial has room for; multiple of four."""
    return -4 * (-max(2, components) * count // 4) + 4


@kernel
def growth(
    keys,
    k,
    z,
    drive,
    scale,
    offsets,
    noise,
    network,
    scheme,
    in_logarithms,
    before,
    weights_before,
    particles,
    weights,
    mean,
    degenerate,
    parents,
    drawn,
    levels,
):
    """Step k of the univariate nonstationary growth model (29).

    drive is 8 cos(1.2 (k - 1)), scale that of the Gamma noise, offsets (N,) the sensors'. Writes
    particles, weights, mean, and adds to degenerate (trials,) where nothing explains z.
    """
    for trial in range(keys.size):
        x = particles[trial]
        resampling.draw_parents(weights_before[trial], scheme, keys[trial], k, drawn, parents)
        resampling.take(before[trial], parents, x)
        random.fill_uniforms(keys[trial], k, random.MOTION, drawn)
        plants.move_growth(x[0], drawn, drive, scale)
        for i in range(len(levels)):
            plants.level_growth(x[0], offsets[i], levels[i])
        degenerate[trial] += weigh(levels, z[trial], noise, network, in_logarithms, weights[trial])
        resampling.weighted_mean(x, weights[trial], mean[trial])


@kernel
def signal_strength(
    keys,
    k,
    z,
    time,
    root,
    sensors,
    level_at_one,
    slope,
    noise,
    network,
    scheme,
    in_logarithms,
    before,
    weights_before,
    particles,
    weights,
    mean,
    degenerate,
    parents,
    drawn,
    levels,
):
    """Step k of a target tracked by the strength of its signal (30)-(32).

    time is the sampling time, root (2, 2) the lower factor of Q of an axis, sensors (N, axes)
    their positions; a level is level_at_one + slope log(squared distance). Writes as `growth`.
    """
    for trial in range(keys.size):
        x = particles[trial]
        resampling.draw_parents(weights_before[trial], scheme, keys[trial], k, drawn, parents)
        resampling.take(before[trial], parents, x)
        random.fill_normals(keys[trial], k, random.MOTION, drawn)
        plants.move_target(x, drawn, time, root)
        for i in range(len(sensors)):
            plants.level_signal_strength(x, sensors[i], level_at_one, slope, levels[i])
        degenerate[trial] += weigh(levels, z[trial], noise, network, in_logarithms, weights[trial])
        resampling.weighted_mean(x, weights[trial], mean[trial])


@kernel
def weigh(levels, z, noise, network, in_logarithms, weights):
    """Weights (13) from levels h^i(x), (N, particles); returns whether none explains z (N,).

    Products of the likelihoods; where all of them underflow, sums of their logarithms instead, if
    those are asked for.
    """
    gaussian = noise[-1] > 0.0
    weights[:] = 1.0
    for i in range(len(levels)):
        if gaussian:
            gaussian_likelihood(levels[i], z[i], noise[i] + noise[-1], noise[-1], network, weights)
        else:
            exponential_likelihood(levels[i], z[i], noise[i], network, weights)
    if in_logarithms and resampling.total(weights) < resampling.UNDERFLOWS:
        weights[:] = 0.0
        for i in range(len(levels)):
            if gaussian:
                gaussian_log_likelihood(
                    levels[i], z[i], noise[i] + noise[-1], noise[-1], network, weights
                )
            else:
                exponential_log_likelihood(levels[i], z[i], noise[i], network, weights)
        return resampling.normalise_logarithms(weights)
    return resampling.normalise(weights)


@kernel
def gaussian_likelihood(levels, z, variance, channel_variance, network, weights):
    """Multiply the weights by (27) of one sensor; variance: of both noises together (28)."""
    transmission, saturation, limit = network
    clipped = transmission * saturation
    lost = (1.0 - transmission) * normal_density(z, channel_variance)
    low = clipped * normal_density(z + limit, variance) + lost
    high = clipped * normal_density(z - limit, variance) + lost
    peak, scale = 1.0 / np.sqrt(2.0 * np.pi * variance), -0.5 / variance
    within, beyond = transmission * peak, (transmission - clipped) * peak
    for j in range(levels.size):
        h = levels[j]
        below, above = h < -limit, h > limit
        factor = beyond if below or above else within
        other = low if below else (high if above else lost)
        error = z - h
        weights[j] *= factor * exp(scale * (error * error)) + other


@kernel
def exponential_likelihood(levels, z, mean, network, weights):
    """Multiply the weights by (27) of one sensor; mean: of either noise."""
    transmission, saturation, limit = network
    clipped = transmission * saturation
    rate = 1.0 / mean
    lost = (1.0 - transmission) * (rate * exp(-rate * z) if z >= 0.0 else 0.0)
    low = clipped * erlang_density(z + limit, rate) + lost
    high = clipped * erlang_density(z - limit, rate) + lost
    within, beyond = transmission * rate * rate, (transmission - clipped) * rate * rate
    for j in range(levels.size):
        h = levels[j]
        below, above = h < -limit, h > limit
        factor = beyond if below or above else within
        other = low if below else (high if above else lost)
        error = z - h
        error = 0.0 if error < 0.0 else error
        weights[j] *= factor * (error * exp(-rate * error)) + other


@kernel
def gaussian_log_likelihood(levels, z, variance, channel_variance, network, log_weights):
    """Add the logarithm of (27) of one sensor."""
    _, _, limit = network
    lost = log_normal(z, channel_variance)
    for j in range(levels.size):
        h = levels[j]
        sent = log_normal(z - h, variance)
        at_limit = log_normal(z - (-limit if h < 0.0 else limit), variance)
        log_weights[j] += log_mixture(sent, at_limit, lost, not -limit <= h <= limit, network)


@kernel
def exponential_log_likelihood(levels, z, mean, network, log_weights):
    """Add the logarithm of (27) of one sensor."""
    _, _, limit = network
    lost = log_exponential(z, mean)
    for j in range(levels.size):
        h = levels[j]
        sent = log_erlang(z - h, mean)
        at_limit = log_erlang(z - (-limit if h < 0.0 else limit), mean)
        log_weights[j] += log_mixture(sent, at_limit, lost, not -limit <= h <= limit, network)


@kernel
def log_mixture(sent, at_limit, lost, beyond, network):
    """Logarithm of the three terms of (15) together, from that of the density in each."""
    transmission, saturation, _ = network
    clipped = transmission * saturation if beyond else 0.0
    clear, gone = transmission - clipped, 1.0 - transmission
    largest = -np.inf
    largest = max(largest, sent) if clear > 0.0 else largest
    largest = max(largest, at_limit) if clipped > 0.0 else largest
    largest = max(largest, lost) if gone > 0.0 else largest
    if largest == -np.inf:
        return largest
    total = clear * exp(sent - largest) if clear > 0.0 else 0.0
    total += clipped * exp(at_limit - largest) if clipped > 0.0 else 0.0
    total += gone * exp(lost - largest) if gone > 0.0 else 0.0
    return largest + log(total)


@scalar
def normal_density(error, variance):
    """Density of N(0, variance)."""
    return exp(-0.5 * error * error / variance) / np.sqrt(2.0 * np.pi * variance)


@scalar
def erlang_density(error, rate):
    """Density of the sum of two exponentials (28)."""
    return rate * rate * error * exp(-rate * error) if error > 0.0 else 0.0


@scalar
def log_normal(error, variance):
    """Log density of N(0, variance)."""
    return -0.5 * (error * error / variance + log(2.0 * np.pi * variance))


@scalar
def log_exponential(z, mean):
    """Log density of an exponential; -inf below zero."""
    return -z / mean - log(mean) if z >= 0.0 else -np.inf


@scalar
def log_erlang(error, mean):
    """Log density of the sum of two exponentials (28); -inf from zero down."""
    return log(error) - error / mean - 2.0 * log(mean) if error > 0.0 else -np.inf
