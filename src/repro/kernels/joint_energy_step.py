"""Bootstrap steps whose particles carry the law of battery and harvest of each sensor.

As `sensor_network_step`, which see for the particles, noise and network; but a measurement is
weighed by whether the battery is empty, and the likelihoods of both cases update the law of the
pair (E, H). Laws are (trials, N, pairs, particles), each over the pairs sums to one.

energy   transition matrix of the pairs (pairs, pairs), whether E = 0 in each (pairs,)
state    particles, weights, laws, means; of `after` degenerate updates (trials,) besides
scratch  parents (particles,) int64, random numbers, rows (N + pairs + ROWS, particles)
"""

import numpy as np

from repro.kernels import random, resampling
from repro.kernels import sensed_plants as plants
from repro.kernels import sensor_network_step as plain
from repro.kernels.compiled import kernel
from repro.kernels.elementary import exp, log

ROWS = 6  # of the scratch, besides those of sensors and pairs


@kernel
def growth(keys, k, z, plant, noise, network, energy, scheme, before, after, scratch):
    """Step k of the univariate nonstationary growth model [energy_harvesting (29)].

    plant: 8 cos(1.2 (k - 1)), scale of the Gamma noise, offsets (N,) of the sensors.
    """
    particles_before, weights_before, _, _ = before
    particles, _, _, _, _ = after
    parents, drawn, rows = scratch
    drive, scale, offsets = plant
    for trial in range(keys.size):
        x = particles[trial]
        resampling.draw_parents(weights_before[trial], scheme, keys[trial], k, drawn, parents)
        resampling.take(particles_before[trial], parents, x)
        random.fill_uniforms(keys[trial], k, random.MOTION, drawn)
        plants.move_growth(x[0], drawn, drive, scale)
        for i in range(len(offsets)):
            plants.level_growth(x[0], offsets[i], rows[i])
        weigh(trial, z, noise, network, energy, before, after, scratch)


@kernel
def signal_strength(keys, k, z, plant, noise, network, energy, scheme, before, after, scratch):
    """Step k of a target tracked by the strength of its signal [energy_harvesting (30)-(32)].

    plant: sampling time, root (2, 2), sensors (N, axes), level at a distance of one, its slope over
    log(distance^2).
    """
    particles_before, weights_before, _, _ = before
    particles, _, _, _, _ = after
    parents, drawn, rows = scratch
    time, root, sensors, level_at_one, slope = plant
    for trial in range(keys.size):
        x = particles[trial]
        resampling.draw_parents(weights_before[trial], scheme, keys[trial], k, drawn, parents)
        resampling.take(particles_before[trial], parents, x)
        random.fill_normals(keys[trial], k, random.MOTION, drawn)
        plants.move_target(x, drawn, time, root)
        for i in range(len(sensors)):
            plants.level_signal_strength(x, sensors[i], level_at_one, slope, rows[i])
        weigh(trial, z, noise, network, energy, before, after, scratch)


@kernel
def weigh(trial, z, noise, network, energy, before, after, scratch):
    """Weights, laws and estimate of one trial, in logarithms where the weights would underflow."""
    particles, all_weights, _, mean, degenerate = after
    weights = all_weights[trial]
    update(trial, z, noise, network, energy, before, after, scratch, False)
    if resampling.total(weights) < resampling.UNDERFLOWS:
        update(trial, z, noise, network, energy, before, after, scratch, True)
        degenerate[trial] += resampling.normalise_logarithms(weights)
    else:
        degenerate[trial] += resampling.normalise(weights)
    resampling.weighted_mean(particles[trial], weights, mean[trial])


@kernel
def update(trial, z, noise, network, energy, before, after, scratch, in_logarithms):
    """Product of the likelihoods p(z^i | x(0..k), Z(1..k-1)), or sum of their logarithms."""
    _, _, laws_before, _ = before
    _, all_weights, laws, _, _ = after
    parents, _, rows = scratch
    chain, empty = energy
    weights, sensors = all_weights[trial], z.shape[1]
    levels, taken, work = rows[:sensors], rows[sensors:-ROWS], rows[-ROWS:]
    sent, lost, transmits, is_empty = work[0], work[1], work[2], work[3]
    likelihood, largest = work[4], work[5]
    weights[:] = 0.0 if in_logarithms else 1.0
    for i in range(sensors):
        law = laws[trial, i]
        resampling.take(laws_before[trial, i], parents, taken)
        predict(taken, chain, law)
        if in_logarithms:
            log_densities(levels[i], z[trial, i], noise, i, network, sent, lost, largest)
        else:
            densities(levels[i], z[trial, i], noise, i, network, sent, lost)
        is_empty[:] = 0.0
        transmits[:] = 0.0
        for pair in range(len(law)):
            of_case = is_empty if empty[pair] else transmits
            for j in range(weights.size):
                of_case[j] += law[pair, j]
        for j in range(weights.size):
            likelihood[j] = lost[j] * is_empty[j] + sent[j] * transmits[j]
        for j in range(weights.size):  # where nothing explains z the law stays as predicted
            explained = likelihood[j] > 0.0
            scale = 1.0 / likelihood[j]
            sent[j] = sent[j] * scale if explained else 1.0
            lost[j] = lost[j] * scale if explained else 1.0
        for pair in range(len(law)):
            factor = lost if empty[pair] else sent
            for j in range(weights.size):
                law[pair, j] *= factor[j]
        if in_logarithms:
            for j in range(weights.size):
                weights[j] += log(likelihood[j]) + largest[j]
        else:
            for j in range(weights.size):
                weights[j] *= likelihood[j]


@kernel
def predict(law, chain, predicted):
    """Law of (E(k), H(k)) from that of step k - 1."""
    predicted[:] = 0.0
    for following in range(len(chain)):
        for pair in range(len(chain)):
            probability = chain[pair, following]
            if probability > 0.0:
                for j in range(law.shape[1]):
                    predicted[following, j] += probability * law[pair, j]


@kernel
def densities(levels, z, noise, i, network, sent, lost):
    """Densities of z of one sensor that transmits, and of one that does not."""
    sent[:] = 1.0
    if noise[-1] > 0.0:
        variance = noise[i] + noise[-1]
        plain.gaussian_likelihood(levels, z, variance, noise[-1], network, sent)
        lost[:] = plain.normal_density(z, noise[-1])
    else:
        plain.exponential_likelihood(levels, z, noise[i], network, sent)
        lost[:] = exp(plain.log_exponential(z, noise[i]))


@kernel
def log_densities(levels, z, noise, i, network, sent, lost, largest):
    """The same relative to the larger of the two, whose logarithm is `largest`."""
    sent[:] = 0.0
    if noise[-1] > 0.0:
        variance = noise[i] + noise[-1]
        plain.gaussian_log_likelihood(levels, z, variance, noise[-1], network, sent)
        log_lost = plain.log_normal(z, noise[-1])
    else:
        plain.exponential_log_likelihood(levels, z, noise[i], network, sent)
        log_lost = plain.log_exponential(z, noise[i])
    for j in range(levels.size):
        larger = max(sent[j], log_lost)
        reference = larger if larger > -np.inf else 0.0
        sent[j] = exp(sent[j] - reference)
        lost[j] = exp(log_lost - reference)
        largest[j] = reference
