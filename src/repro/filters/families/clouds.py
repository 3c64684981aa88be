"""What filters say of weighted particles."""

from collections.abc import Sequence

import numpy as np

from repro.kernels import covariances


def weighted_covariance(
    particles: np.ndarray, weights: np.ndarray, mean: np.ndarray, components: Sequence[int]
) -> np.ndarray:
    """Covariance of some components of each trial's particles about their mean, (trials, d, d).

    particles (trials, n, particles), weights (trials, particles), mean (trials, n).
    """
    found = np.empty((len(weights), len(components), len(components)))
    covariances.of_particles(particles, weights, mean, np.array(components), found)
    return found
