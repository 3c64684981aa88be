"""Particles that are loss sequences, of one trial after another [unknown_losses Algorithms 3, 4].

The Kalman filters of the particles are columns (`kalman_step`), those of a trial side by side from
first[trial] on, first (trials + 1,). Particle j of a trial has column[trial, j], or if `own` the
jth of its trial. gamma, log_weights, weights, parents and column are (trials, particles); row
(particles,) is scratch.
"""

from repro.kernels import random, resampling
from repro.kernels.compiled import kernel
from repro.kernels.elementary import log, logaddexp
from repro.kernels.kalman_step import packed


@kernel
def of_columns(values, first, out):
    """Values (trials, m) of each column's trial, (m, columns)."""
    for trial in range(len(values)):
        for i in range(len(out)):
            out[i, first[trial] : first[trial + 1]] = values[trial, i]


@kernel
def of_particles(values, begin, own, column, row):
    """Values (columns,) of the particles of one trial, in `row`."""
    if own:
        for j in range(row.size):
            row[j] = values[begin + j]
    else:
        for j in range(row.size):
            row[j] = values[column[j]]


@kernel
def sample_and_select(keys, k, sampling, selecting, evidence, before, after, row, drawn):
    """Steps 2 and 3 of all trials.

    sampling  Pr(gamma(k) = 1) after a loss and after an arrival, (2,); whether gamma(k) is drawn
              given y(k) too
    selecting number of effective particles below which parents are drawn, and the scheme
    before    gamma and log_weights of step k - 1
    after     of step k: gamma before 3c, log_weights, weights, parents; resampled (trials,)
              bool; degenerate (trials,), to which are added the trials that no particle explains
    evidence  log p(y(k) | Y(k-1), Gamma(k)) for gamma(k) = 1, (columns,), and for 0, (trials,);
              first, own, column
    drawn (2 particles + 4,): scratch.
    """
    arrival, optimal = sampling
    gamma_before, logarithms_before = before
    gamma, log_weights, weights, parents, resampled, degenerate = after
    threshold, scheme = selecting
    likelihood, noise, first, own, column = evidence
    for trial in range(keys.size):
        of_particles(likelihood, first[trial], own, column[trial], row)
        known = arrival, row, noise[trial], gamma_before[trial], logarithms_before[trial]
        uniforms = drawn[: random.padded(row.size + 1)]
        random.fill_uniforms(keys[trial], k, random.ARRIVALS, uniforms)
        if optimal:
            draw_given_measurement(uniforms, known, gamma[trial], log_weights[trial])
        else:
            draw_from_prior(uniforms, known, gamma[trial], log_weights[trial])
        of_trial, chosen = weights[trial], parents[trial]
        for j in range(row.size):
            of_trial[j] = log_weights[trial, j]
        failed = resampling.normalise_logarithms(of_trial)
        degenerate[trial] += failed
        resampled[trial] = resampling.effective_sample_size(of_trial) < threshold
        if resampled[trial]:  # 3a, 3b
            resampling.draw_parents(of_trial, scheme, keys[trial], k, drawn, chosen)
            of_trial[:] = 1.0 / row.size
        else:
            for j in range(row.size):
                chosen[j] = j
        if resampled[trial] or failed:  # 3c
            log_weights[trial, :] = 0.0


@kernel
def draw_from_prior(uniforms, known, gamma, log_weights):
    """As in the algorithm: the priors in (19) cancel."""
    arrival, likelihood, noise, last, log_weights_before = known
    lost_below, lost_below_next = 1.0 - arrival[0], 1.0 - arrival[1]
    for j in range(gamma.size):
        arrived = uniforms[j] >= (lost_below_next if last[j] > 0.5 else lost_below)
        gamma[j] = 1.0 if arrived else 0.0
        log_weights[j] = log_weights_before[j] + (likelihood[j] if arrived else noise)


@kernel
def draw_given_measurement(uniforms, known, gamma, log_weights):
    """Sec. IV-B, the optimal proposal: the weights gain p(y(k) | Y(k-1), Gamma(k-1))."""
    arrival, likelihood, noise, last, log_weights_before = known
    for j in range(gamma.size):
        probability = arrival[1] if last[j] > 0.5 else arrival[0]
        arrived = log(probability) + likelihood[j]
        lost = log(1.0 - probability) + noise
        threshold = log(1.0 - uniforms[j]) - log(uniforms[j])
        gamma[j] = 1.0 if arrived - lost >= threshold else 0.0
        log_weights[j] = log_weights_before[j] + logaddexp(arrived, lost)


@kernel
def take_parents(resampled, parents, estimate, sigma, gamma, row):
    """Step 3c where a column is a particle: the triples of the parents take the place of all."""
    count = row.size
    for trial in range(resampled.size):
        if resampled[trial]:
            begin, end = trial * count, (trial + 1) * count
            take(gamma[trial], parents[trial], row)
            for i in range(len(estimate)):
                take(estimate[i, begin:end], parents[trial], row)
            for i in range(len(sigma)):
                take(sigma[i, begin:end], parents[trial], row)


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
def means(estimate, first, own, column, weights, out, row):
    """(16): weighted sums over the particles, (trials, n), of estimates (n, columns)."""
    for trial in range(len(out)):
        for i in range(len(estimate)):
            if own:  # without a copy
                of_trial = estimate[i, first[trial] : first[trial + 1]]
                out[trial, i] = resampling.weighted_total(weights[trial], of_trial)
            else:
                of_particles(estimate[i], first[trial], own, column[trial], row)
                out[trial, i] = resampling.weighted_total(weights[trial], row)


@kernel
def variances(estimate, sigma, mean, spread, first, own, column, weights, out, rows):
    """Diagonal of (17), (trials, n), if wanted with the spread of the estimates about their mean.

    rows (2, particles): scratch.
    """
    values, row = rows[0], rows[1]
    place = 0
    for i in range(len(estimate)):
        for trial in range(len(out)):
            of_particles(sigma[place], first[trial], own, column[trial], values)
            if spread:
                of_particles(estimate[i], first[trial], own, column[trial], row)
                centre = mean[trial, i]
                for j in range(row.size):
                    error = row[j] - centre
                    values[j] += error * error
            out[trial, i] = resampling.weighted_total(weights[trial], values)
        place += len(estimate) - i


@kernel
def covariances(estimate, sigma, mean, spread, first, own, column, weights, components, out, rows):
    """(17) of some components, out (trials, d, d), as `variances` has its diagonal.

    components (d,); rows (3, particles): scratch.
    """
    n, values, one, other = len(estimate), rows[0], rows[1], rows[2]
    for a in range(components.size):
        i = components[a]
        for b in range(a + 1):
            j = components[b]
            entry = sigma[packed(i, j, n)]
            for trial in range(len(out)):
                of_particles(entry, first[trial], own, column[trial], values)
                if spread:
                    of_particles(estimate[i], first[trial], own, column[trial], one)
                    of_particles(estimate[j], first[trial], own, column[trial], other)
                    for p in range(values.size):
                        values[p] += (one[p] - mean[trial, i]) * (other[p] - mean[trial, j])
                out[trial, a, b] = resampling.weighted_total(weights[trial], values)
                out[trial, b, a] = out[trial, a, b]
