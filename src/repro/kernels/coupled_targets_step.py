"""Steps of the particle filters of randomly coupled targets [censored_network Algorithm 1].

One kernel a filter, in the order of the algorithm, one trial and one target (node) after another.
Particles are (trials, nodes, 3, particles), weights (trials, nodes, particles), means (trials,
nodes, 3). Within a node each loop over the particles does one thing, so that it is vectorised.

What a step needs besides is in tuples; reading and network are those of `censored_likelihood`:
motion   speed (nodes,), turn rate, deviations of the process noise (3,), coupling (nodes, nodes),
         coupling rate, whether each particle draws its coupling
before, after  particles, weights, means, effective sample sizes (trials,), degenerate updates
         (trials,); of the step before, and of this one, which is written
scratch  parents (particles,) int64, random numbers (`drawn_length`,), rows (ROWS, particles)
"""

from repro.kernels import random, resampling
from repro.kernels.censored_likelihood import likelihood, of_node
from repro.kernels.compiled import kernel
from repro.kernels.elementary import sin, sine_cosine
from repro.kernels.resampling import draw_parents, take, weighted_mean

ROWS = 10  # of the scratch


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
