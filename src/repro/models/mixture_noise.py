"""Zero-mean noise of two Gaussians, one of them rare and wide: the glint noise of tracking.

(1 - kappa) N(0, sigma_1^2) + kappa N(0, sigma_2^2), (25) of Song et al.; sigma are standard
deviations, which the text below (25) calls variances.
"""

from typing import NamedTuple

import numpy as np
from scipy.special import log_ndtr


class MixtureNoise(NamedTuple):
    """In dB, as the signal strength that it disturbs."""

    glint_probability: float  # kappa
    nominal_deviation: float  # sigma_1
    glint_deviation: float  # sigma_2

    def sample(self, uniform: np.ndarray, normal: np.ndarray) -> np.ndarray:
        """Noise from a uniform, which picks the component, and a standard normal."""
        glint = uniform < self.glint_probability
        return np.where(glint, self.glint_deviation, self.nominal_deviation) * normal

    def log_density(self, error: np.ndarray) -> np.ndarray:
        """log p(error), written over `error`: one exp and one log1p whatever the distance.

        With p_2 the wide component, log p = log p_2 + log(1 + p_1 / p_2).
        """
        narrow, wide = 0.5 / self.nominal_deviation**2, 0.5 / self.glint_deviation**2
        wide_share = self.glint_probability / self.glint_deviation
        with np.errstate(divide="ignore"):  # kappa = 0 or 1 is one Gaussian
            log_ratio = np.log((1 - self.glint_probability) / self.nominal_deviation) - np.log(
                wide_share
            )
        error *= error
        ratio = error * (wide - narrow)
        ratio += log_ratio
        np.exp(ratio, out=ratio)
        np.log1p(ratio, out=ratio)
        error *= -wide
        error += ratio
        error += np.log(wide_share / np.sqrt(2 * np.pi))
        return error

    def log_below(self, t: np.ndarray) -> np.ndarray:
        """log F(t), with F the cumulative distribution; log(1 - F(t)) is log F(-t)."""
        with np.errstate(divide="ignore"):
            return np.logaddexp(
                np.log1p(-self.glint_probability) + log_ndtr(t / self.nominal_deviation),
                np.log(self.glint_probability) + log_ndtr(t / self.glint_deviation),
            )

    def log_between(self, low: np.ndarray, high: np.ndarray) -> np.ndarray:
        """log(F(high) - F(low)), from whichever tail loses no digits."""
        flip = low + high > 0
        upper = self.log_below(np.where(flip, -low, high))
        lower = self.log_below(np.where(flip, -high, low))
        with np.errstate(divide="ignore"):
            return upper + np.log(-np.expm1(lower - upper))
