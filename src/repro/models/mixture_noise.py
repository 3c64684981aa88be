"""Zero-mean mixture of two Gaussians, one of them rare and wide: glint noise.

(1 - kappa) N(0, sigma_1^2) + kappa N(0, sigma_2^2) [censored_network (25)]; the sigmas are
standard deviations, although the text below (25) calls them variances.
"""

from typing import NamedTuple

import numpy as np


class MixtureNoise(NamedTuple):
    """Deviations are in dB, as is the signal strength."""

    glint_probability: float  # kappa
    nominal_deviation: float  # sigma_1
    glint_deviation: float  # sigma_2

    def sample(self, uniform: np.ndarray, normal: np.ndarray) -> np.ndarray:
        """Noise from a uniform, which chooses the component, and a standard normal; same shapes."""
        glint = uniform < self.glint_probability
        return np.where(glint, self.glint_deviation, self.nominal_deviation) * normal
