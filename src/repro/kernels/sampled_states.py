"""Particles that are states with their losses, of one trial after another: a bootstrap filter.

Those of a trial lie side by side: states are (n, trials * particles), gamma and weights
(trials, particles).
"""

from repro.kernels import resampling
from repro.kernels.compiled import kernel
from repro.kernels.rao_blackwell_step import take


@kernel
def select(keys, k, weights, scheme, states, gamma, parents, drawn, row):
    """Draw the particles of every trial as their weights, in place.

    parents (particles,) int64, drawn (2 particles + 4,) and row (particles,): scratch.
    """
    for trial in range(keys.size):
        begin, end = trial * row.size, (trial + 1) * row.size
        resampling.draw_parents(weights[trial], scheme, keys[trial], k, drawn, parents)
        take(gamma[trial], parents, row)
        for i in range(len(states)):
            take(states[i, begin:end], parents, row)


@kernel
def weigh(weights, states, mean, degenerate):
    """Turn log weights into weights, and add up the means, (trials, n), of the states.

    Adds to degenerate (trials,) where no particle explains the measurement.
    """
    count = weights.shape[1]
    for trial in range(len(weights)):
        degenerate[trial] += resampling.normalise_logarithms(weights[trial])
        for i in range(len(states)):
            of_trial = states[i, trial * count : (trial + 1) * count]
            mean[trial, i] = resampling.weighted_total(weights[trial], of_trial)
