"""Bootstrap steps with saturating, energy-harvesting sensors [energy_harvesting Algorithm 1].

One kernel a model, in the order of the algorithm, one trial after another. Particles are
(trials, n, particles), weights (trials, particles), means (trials, n), measurements z (trials, N).
"""

import numpy as np

from repro.kernels import compiled_resampling as resampling
from repro.kernels import random
from repro.kernels.compiled import kernel, scalar
from repro.kernels.elementary import exp, log, log_of_normal, logaddexp

SYSTEMATIC, MULTINOMIAL = range(2)
# Below this sum of their likelihoods, particles are weighted in logarithms.
UNDERFLOWS = 1e-200


@kernel
def draw_parents(weights, scheme, key, k, parents):
    """Indices of the particles that are drawn, as the weights."""
    if scheme == SYSTEMATIC:
        uniform = random.uniforms(key, k, random.RESAMPLING, 0)[0]
        resampling.systematic(weights, uniform, parents)
    else:
        uniforms = np.empty(random.padded(weights.size + 1))
        random.fill_uniforms(key, k, random.RESAMPLING, uniforms)
        resampling.multinomial(weights, uniforms, parents)


@kernel
def weigh(levels, z, noise, network, in_logarithms, weights):
    """Weights of one trial from levels h (N, particles); returns whether none explains z.

    noise (N + 1,): of Gaussian noise the variances at the sensors, and the channel's; of
    exponential noise, which is told by a last entry of zero, the mean of each.
    network: lambda(k), gbar and the saturation level.
    """
    transmission, saturation, limit = network
    gaussian = noise[-1] > 0.0
    weights[:] = 1.0
    for i in range(len(levels)):
        if gaussian:
            gaussian_likelihood(levels[i], z[i], noise[i] + noise[-1], noise[-1], network, weights)
        else:
            exponential_likelihood(levels[i], z[i], noise[i], network, weights)
    if in_logarithms and resampling.total(weights) < UNDERFLOWS:
        weights[:] = 0.0
        for i in range(len(levels)):
            for j in range(weights.size):
                h = levels[i, j]
                beyond = h < -limit or h > limit
                clear = transmission * (1.0 - saturation) if beyond else transmission
                clipped = transmission * saturation if beyond else 0.0
                at_limit = -limit if h < -limit else limit
                if gaussian:
                    variance = noise[i] + noise[-1]
                    of_level = log_normal(z[i] - h, variance)
                    of_limit = log_normal(z[i] - at_limit, variance)
                    of_channel = log_normal(z[i], noise[-1])
                else:
                    of_level = log_erlang(z[i] - h, noise[i])
                    of_limit = log_erlang(z[i] - at_limit, noise[i])
                    of_channel = log_exponential(z[i], noise[i])
                likelihood = logaddexp(log(clear) + of_level, log(clipped) + of_limit)
                weights[j] += logaddexp(likelihood, log(1.0 - transmission) + of_channel)
        return resampling.normalise_logarithms(weights)
    return resampling.normalise(weights)


@kernel
def gaussian_likelihood(levels, z, variance, channel_variance, network, weights):
    """Multiply the weights by (27) of one sensor: (15) with Gaussian noises."""
    transmission, saturation, limit = network
    peak = 1.0 / np.sqrt(2.0 * np.pi * variance)
    lost = (1.0 - transmission) * exp(log_normal(z, channel_variance))
    low = transmission * saturation * exp(log_normal(z + limit, variance))
    high = transmission * saturation * exp(log_normal(z - limit, variance))
    within, beyond = transmission * peak, transmission * (1.0 - saturation) * peak
    scale = -0.5 / variance
    for j in range(levels.size):
        h = levels[j]
        error = z - h
        other = low if h < -limit else (high if h > limit else 0.0)
        factor = within if -limit <= h <= limit else beyond
        weights[j] *= factor * exp(scale * (error * error)) + (other + lost)


@kernel
def exponential_likelihood(levels, z, mean, network, weights):
    """Multiply the weights by (27) of one sensor: (15) with exponential noises of one mean."""
    transmission, saturation, limit = network
    rate = 1.0 / mean
    lost = (1.0 - transmission) * exp(log_exponential(z, mean))
    low = transmission * saturation * exp(log_erlang(z + limit, mean))
    high = transmission * saturation * exp(log_erlang(z - limit, mean))
    within = transmission * rate * rate
    beyond = within * (1.0 - saturation)
    for j in range(levels.size):
        h = levels[j]
        error = z - h
        error = error if error > 0.0 else 0.0
        other = low if h < -limit else (high if h > limit else 0.0)
        factor = within if -limit <= h <= limit else beyond
        weights[j] *= factor * (error * exp(-rate * error)) + (other + lost)


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
    return log(max(error, 0.0)) - error / mean - 2.0 * log(mean)


@kernel
def finish(particles, weights, mean):
    """The estimate of one trial: the weighted mean."""
    for component in range(len(particles)):
        mean[component] = resampling.weighted_total(weights, particles[component])


@kernel
def ungm(
    keys,
    k,
    z,
    plant,
    noise,
    network,
    scheme,
    in_logarithms,
    before,
    particles,
    weights,
    mean,
    degenerate,
):
    """Step k of the univariate nonstationary growth model [energy_harvesting (29)].

    plant (1 + 1 + N,): the deterministic drive 8 cos(1.2 (k - 1)), the scale of the Gamma noise,
    the sensors' offsets. `before` holds the particles of step k - 1; particles, weights, mean and
    degenerate (trials,) are written, the weights after they are read.
    """
    count, sensors = particles.shape[2], z.shape[1]
    drive, noise_scale, offsets = plant[0], plant[1], plant[2:]
    parents = np.empty(count, dtype=np.int64)
    uniforms = np.empty(random.padded(2 * count))
    levels = np.empty((sensors, count))
    for trial in range(keys.size):
        draw_parents(weights[trial], scheme, keys[trial], k, parents)
        random.fill_uniforms(keys[trial], k, random.MOTION, uniforms)
        first, second = uniforms[:count], uniforms[count : 2 * count]
        source, x = before[trial, 0], particles[trial, 0]
        for j in range(count):
            last = source[parents[j]]
            # Gamma noise of shape two: the sum of two exponentials
            w = -noise_scale * log_of_normal(first[j] * second[j])
            x[j] = (0.5 * last + 25.0 * last / (1.0 + last * last) + drive) + w
        for i in range(sensors):
            for j in range(count):
                offset = x[j] - offsets[i]
                levels[i, j] = offset * offset / 20.0
        degenerate[trial] += weigh(levels, z[trial], noise, network, in_logarithms, weights[trial])
        finish(particles[trial], weights[trial], mean[trial])
