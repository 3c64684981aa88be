"""What a filter claims of its error beside the error itself: is its covariance true?"""

from collections.abc import Mapping, Sequence

import numpy as np

from repro.kernels import covariances as kernels
from repro.statistics.consistency import claimed, normalised


def judged_claims(
    error: np.ndarray,
    groups: Mapping[str, Sequence[int]],
    covariances: Mapping[str, np.ndarray],
) -> dict[str, np.ndarray]:
    """NEES and claimed mean square error, (trials, steps) each, to be kept with the runs.

    error (trials, steps, n), groups of components by name, and covariances (trials, steps, d, d)
    that the filter claims of them. NEES is e' P^-1 e / d (Bar-Shalom, Li, Kirubarajan 2001,
    Sec. 5.4); an error in a direction in which the filter claims none makes it infinite.
    """
    found = {}
    for name, of_group in covariances.items():
        trials, steps, d, _ = of_group.shape
        errors = np.ascontiguousarray(error[..., groups[name]]).reshape(-1, d)
        squared = np.empty(trials * steps)
        kernels.normalised_errors(errors, of_group.reshape(-1, d, d), np.empty((d, d + 1)), squared)
        found[normalised(name)] = squared.reshape(trials, steps) / d
        found[claimed(name)] = np.diagonal(of_group, axis1=2, axis2=3).sum(axis=-1)
    return found
