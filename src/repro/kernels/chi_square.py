"""The chi-square distribution: probabilities and quantiles for any number of degrees of freedom."""

import numpy as np

from repro.kernels.compiled import kernel
from repro.kernels.elementary import exp, log

SHIFTED_TO = 20.0  # from where Stirling's series is exact to the last digits
HALVINGS = 200


@kernel
def _log_gamma(a):
    """Logarithm of the Gamma function of a > 0, by Stirling's series."""
    product = 1.0
    while a < SHIFTED_TO:
        product *= a
        a += 1.0
    inverse = 1.0 / a
    square = inverse * inverse
    series = 1.0 / 12.0 - square * (1.0 / 360.0 - square * (1.0 / 1260.0 - square / 1680.0))
    return (a - 0.5) * log(a) - a + 0.5 * log(2.0 * np.pi) + inverse * series - log(product)


@kernel
def probability_below(x, freedom):
    """Probability that a chi-square variable is below x, by the series of the lower Gamma."""
    if x <= 0.0:
        return 0.0
    a, half = 0.5 * freedom, 0.5 * x
    term = total = 1.0
    n = a
    while term > 1e-17 * total or half > n:
        n += 1.0
        term *= half / n
        total += term
        if total > 1e290:  # only far above the mean, where the probability is one
            return 1.0
    return min(1.0, total * exp(a * log(half) - half - _log_gamma(a + 1.0)))


@kernel
def quantile(probability, freedom):
    """The value below which a chi-square variable is with a probability in (0, 1)."""
    low, high = 0.0, freedom + 10.0
    while probability_below(high, freedom) < probability:
        high *= 2.0
    for _ in range(HALVINGS):
        middle = 0.5 * (low + high)
        if middle in (low, high):
            break
        if probability_below(middle, freedom) < probability:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)
