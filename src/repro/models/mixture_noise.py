"""Zero-mean mixture of two Gaussians, one of them rare and wide: glint noise.

(1 - kappa) N(0, sigma_1^2) + kappa N(0, sigma_2^2) [censored_network (25)]; the sigmas are
standard deviations, although the text below (25) calls them variances.
"""

from typing import NamedTuple

import numpy as np
from scipy.special import log_ndtr


class MixtureNoise(NamedTuple):
    """Deviations are in dB, as is the signal strength."""

    glint_probability: float  # kappa
    nominal_deviation: float  # sigma_1
    glint_deviation: float  # sigma_2

    def sample(self, uniform: np.ndarray, normal: np.ndarray) -> np.ndarray:
        """Noise from a uniform, which chooses the component, and a standard normal; same shapes."""
        glint = uniform < self.glint_probability
        return np.where(glint, self.glint_deviation, self.nominal_deviation) * normal

    def log_density(self, error: np.ndarray) -> np.ndarray:
        """log p(error), written over `error`, with one exp and one log1p at any distance.

        With p_2 the wide component, log p = log p_2 + log(1 + p_1 / p_2).
        """
        narrow, wide = 0.5 / self.nominal_deviation**2, 0.5 / self.glint_deviation**2
        wide_share = self.glint_probability / self.glint_deviation
        with np.errstate(divide="ignore"):  # kappa = 0 or 1: a single Gaussian
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
        """log F(t), F the cumulative distribution; by symmetry log(1 - F(t)) is log F(-t)."""
        with np.errstate(divide="ignore"):
            return np.logaddexp(
                np.log1p(-self.glint_probability) + log_ndtr(t / self.nominal_deviation),
                np.log(self.glint_probability) + log_ndtr(t / self.glint_deviation),
            )

    def log_between(self, low: np.ndarray, high: np.ndarray) -> np.ndarray:
        """log(F(high) - F(low)), taken in the tail in which the difference loses no digits."""
        flip = low + high > 0
        upper = self.log_below(np.where(flip, -low, high))
        lower = self.log_below(np.where(flip, -high, low))
        with np.errstate(divide="ignore"):
            return upper + np.log(-np.expm1(lower - upper))
