"""Likelihood of what the network delivers [censored_network Propositions 1 and 2, (14), (21)].

p(y | x) = sum_m p_m prod_j l(y^j | h^{m_j}(x)): every group is compared with the same received
vector. An uncensored reading contributes the density of the noise, a censored one the probability
of the censored interval. Everything is computed in logs.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from repro.models.coupled_targets import CoupledTargets, log_squared_distance
from repro.network.censoring import ABOVE, BELOW, EXACT, INSIDE

STEP = 1 / 32  # dB between the nodes of a table, for an error below 1e-8

LogLikelihood = Callable[[np.ndarray, Any, int], np.ndarray]  # of particles, seen, k


class Table:
    """A smooth function of the signal strength, by cubic pieces between equidistant nodes.

    A censored reading needs two or four normal probabilities, which would cost more than the rest
    of the filter. A table costs as much as two exponentials; a test bounds its error.
    """

    def __init__(self, value: np.ndarray, slope: np.ndarray):
        slope = STEP * slope
        rise = np.diff(value)
        self._pieces = (  # Hermite
            value[:-1],
            slope[:-1],
            3 * rise - 2 * slope[:-1] - slope[1:],
            slope[:-1] + slope[1:] - 2 * rise,
        )

    def __call__(self, place: np.ndarray) -> np.ndarray:
        """Values at `place`, in units of STEP from the first node; `place` is overwritten."""
        piece = place.astype(np.intp)
        place -= piece
        value = self._pieces[3].take(piece)
        for coefficients in self._pieces[2::-1]:
            value *= place
            value += coefficients.take(piece)
        return value


def log_probability(
    model: CoupledTargets, code: int, strength: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Log probability that a reading of this mean strength arrives with `code`, and its slope."""
    lower, upper = model.censoring.lower - strength, model.censoring.upper - strength

    def density(t: np.ndarray) -> np.ndarray:
        return model.noise.log_density(t.copy())

    if code == BELOW:
        value = model.noise.log_below(lower)
        return value, -np.exp(density(lower) - value)
    if code == ABOVE:
        value = model.noise.log_below(-upper)
        return value, np.exp(density(upper) - value)
    value = model.noise.log_between(lower, upper)
    return value, np.exp(density(lower) - value) - np.exp(density(upper) - value)


def build(model: CoupledTargets, compensated: bool = True) -> LogLikelihood:
    """log_likelihood(particles, seen, k) -> (trials, nodes, particles).

    seen.received and seen.code (trials, nodes, b); seen.group_probability (trials, nodes, M).
    Without compensation (NMC) every value counts as an exact reading, and codes are not used.
    """
    groups, size, _ = model.sensors.shape
    # Ordered by reading, then group, so that all values that a code selects are contiguous.
    sensors = model.sensors.swapaxes(0, 1).reshape(-1, 2)
    a, b = model.strength.of_log_squared_distance()
    weakest, strongest = model.strength.range()
    nodes = np.arange(weakest, strongest + 2 * STEP, STEP)
    codes = (INSIDE,) if model.censoring.kind == "dead band" else (BELOW, ABOVE)
    with np.errstate(all="ignore"):  # infinite thresholds, which never censor
        tables = {code: Table(*log_probability(model, code, nodes)) for code in codes}

    def log_likelihood(particles: np.ndarray, seen: Any, k: int) -> np.ndarray:
        log_d2 = log_squared_distance(particles, sensors)
        trials, targets, _, count = log_d2.shape
        readings = log_d2.reshape(trials, targets, size, groups, count)
        code = seen.code if compensated else np.full(seen.received.shape, EXACT)
        exact = code == EXACT
        error = readings[exact]  # y - h
        error *= -b
        error += (seen.received[exact] - a)[:, None, None]
        readings[exact] = model.noise.log_density(error)
        for censoring, table in tables.items():
            hit = code == censoring
            place = readings[hit]
            place *= b / STEP
            place += (a - weakest) / STEP
            readings[hit] = table(place)
        of_group = readings.sum(axis=2)
        with np.errstate(divide="ignore"):  # of a group that is known not to transmit
            of_group += np.log(seen.group_probability)[..., None]
        total = of_group[:, :, 0]
        for m in range(1, groups):
            total = log_sum(total, of_group[:, :, m])
        return total

    return log_likelihood


def log_sum(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """log(exp(first) + exp(second)), where at most one is -inf; five times as fast as logaddexp."""
    larger = np.maximum(first, second)
    gap = np.minimum(first, second)
    gap -= larger
    np.exp(gap, out=gap)
    np.log1p(gap, out=gap)
    larger += gap
    return larger
