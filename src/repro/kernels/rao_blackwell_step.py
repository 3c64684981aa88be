"""Particles that are loss sequences, of one trial after another [unknown_losses Algorithms 3, 4].

The Kalman filters of the particles are columns (`kalman_step`), those of a trial side by side:
particle j of a trial has column[trial, j]. gamma, log_weights, weights, parents and column are
(trials, particles). drawn (m,), m = padded(particles + 1), and row (particles,) are scratch.
"""

from repro.kernels import random, resampling
from repro.kernels.compiled import kernel
from repro.kernels.elementary import log, logaddexp


@kernel
def sample(keys, k, arrival, optimal, likelihood, noise, column, gamma, log_weights, drawn, row):
    """Step 2: gamma becomes gamma(k) of each particle, and its log weight gains (19).

    arrival: Pr(gamma(k) = 1) after a loss, after an arrival; likelihood (columns,) and noise
    (trials,): log p(y(k) | Y(k-1), Gamma(k)) for gamma(k) = 1 and 0; optimal: whether gamma(k) is
    drawn given y(k) too.
    """
    for trial in range(keys.size):
        random.fill_uniforms(keys[trial], k, random.ARRIVALS, drawn)
        of_particles(likelihood, column[trial], row)
        if optimal:
            draw_given_measurement(
                drawn, arrival, row, noise[trial], gamma[trial], log_weights[trial]
            )
        else:
            draw_from_prior(drawn, arrival, row, noise[trial], gamma[trial], log_weights[trial])


@kernel
def of_particles(values, column, row):
    """Values (columns,) of each particle, in `row`."""
    for j in range(row.size):
        row[j] = values[column[j]]


@kernel
def draw_from_prior(uniforms, arrival, likelihood, noise, gamma, log_weights):
    """As in the algorithm: the priors in (19) cancel."""
    lost_below, lost_below_next = 1.0 - arrival[0], 1.0 - arrival[1]
    for j in range(gamma.size):
        arrived = uniforms[j] >= (lost_below_next if gamma[j] > 0.5 else lost_below)
        gamma[j] = 1.0 if arrived else 0.0
        log_weights[j] += likelihood[j] if arrived else noise


@kernel
def draw_given_measurement(uniforms, arrival, likelihood, noise, gamma, log_weights):
    """Sec. IV-B, the optimal proposal: the weights gain p(y(k) | Y(k-1), Gamma(k-1))."""
    for j in range(gamma.size):
        probability = arrival[1] if gamma[j] > 0.5 else arrival[0]
        arrived = log(probability) + likelihood[j]
        lost = log(1.0 - probability) + noise
        threshold = log(1.0 - uniforms[j]) - log(uniforms[j])
        gamma[j] = 1.0 if arrived - lost >= threshold else 0.0
        log_weights[j] += logaddexp(arrived, lost)


@kernel
def select(keys, k, threshold, scheme, log_weights, weights, parents, resampled, degenerate, drawn):
    """Step 3: normalised weights, and parents if few particles are effective, else each its own.

    Few: fewer than threshold. resampled (trials,) bool; degenerate (trials,) counts the trials
    that no particle explains.
    """
    count = weights.shape[1]
    for trial in range(keys.size):
        of_trial, logarithms, chosen = weights[trial], log_weights[trial], parents[trial]
        for j in range(count):
            of_trial[j] = logarithms[j]
        failed = resampling.normalise_logarithms(of_trial)
        degenerate[trial] += failed
        resampled[trial] = resampling.effective_sample_size(of_trial) < threshold
        if resampled[trial]:  # 3a, 3b
            resampling.draw_parents(of_trial, scheme, keys[trial], k, drawn, chosen)
            of_trial[:] = 1.0 / count
        else:
            for j in range(count):
                chosen[j] = j
        if resampled[trial] or failed:  # 3c
            logarithms[:] = 0.0


@kernel
def take_parents(resampled, parents, estimate, sigma, gamma, row):
    """Step 3c where a column is a particle: the triples of the parents take the place of all."""
    count = row.size
    for trial in range(resampled.size):
        if resampled[trial]:
            first, last = trial * count, (trial + 1) * count
            take(gamma[trial], parents[trial], row)
            for i in range(len(estimate)):
                take(estimate[i, first:last], parents[trial], row)
            for i in range(len(sigma)):
                take(sigma[i, first:last], parents[trial], row)


@kernel
def take(values, parents, row):
    """values[j] = values[parents[j]]."""
    for j in range(row.size):
        row[j] = values[parents[j]]
    for j in range(row.size):
        values[j] = row[j]


@kernel
def distinct(parents, first, column, gamma, source, arrived, next_first, triples, place):
    """Step 3c and a) of Algorithm 4: a column for each distinct triple of the parents.

    Particles of one column have equal xh and Sigma: column and gamma number their triples. first
    (trials + 1,) is where the columns of a trial begin. column and gamma become those of the
    parents; writes source and arrived, the old column and the gamma of each new one, and
    next_first; returns how many columns there are. triples (particles,) and place
    (2 particles,): scratch.
    """
    total = 0
    for trial in range(len(parents)):
        begin, of_trial = first[trial], parents[trial]
        size = 2 * (first[trial + 1] - begin)
        place[:size] = -1
        for j in range(triples.size):
            parent = of_trial[j]
            triples[j] = 2 * (column[trial, parent] - begin) + (gamma[trial, parent] > 0.5)
            place[triples[j]] = 0
        for triple in range(size):
            if place[triple] == 0:
                source[total], arrived[total] = begin + triple // 2, triple % 2
                place[triple] = total
                total += 1
        for j in range(triples.size):
            column[trial, j] = place[triples[j]]
            gamma[trial, j] = triples[j] % 2
        next_first[trial + 1] = total
    return total


@kernel
def means(values, column, weights, out, row):
    """Weighted sums over the particles, (trials, n), of values (n, columns)."""
    for trial in range(len(out)):
        for i in range(len(values)):
            of_particles(values[i], column[trial], row)
            out[trial, i] = resampling.weighted_total(weights[trial], row)
