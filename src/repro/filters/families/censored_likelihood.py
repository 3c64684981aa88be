"""Likelihood of what the network delivers [censored_network Propositions 1 and 2, (14), (21)].

p(y | x) = sum_m p_m prod_j l(y^j | h^{m_j}(x)): every group is compared with the same received
vector. An uncensored reading contributes the density of the noise, a censored one the probability
of the censored interval.
"""

from typing import Any

import numpy as np

from repro.kernels import censored_likelihood as kernels
from repro.models.coupled_targets import CoupledTargets
from repro.network.censoring import EXACT


def network(model: CoupledTargets) -> tuple:
    """Sensors and noise, as the kernels have them."""
    sensors = np.array(model.sensors, dtype=float, order="C")
    at_one, slope = model.strength.of_log_squared_distance()
    share, nominal, glint = (float(value) for value in model.noise)
    return sensors, at_one, slope, (1.0 - share, 1.0 / nominal, share, 1.0 / glint)


def reading(model: CoupledTargets, seen: Any, compensated: bool = True) -> tuple:
    """What a receiver knows of the readings: low and high (trials, nodes, b), equal if exact.

    seen.received and seen.code (trials, nodes, b); seen.group_probability (trials, nodes, M).
    Without compensation (NMC) every value counts as an exact reading, and codes are not used.
    """
    low = high = np.array(seen.received, dtype=float, order="C")
    if compensated:
        lower, upper = model.censoring.lower, model.censoring.upper
        exact = seen.code == EXACT  # else BELOW, ABOVE, INSIDE
        low = np.where(exact, low, np.array([0.0, -np.inf, upper, lower])[seen.code])
        high = np.where(exact, high, np.array([0.0, lower, np.inf, upper])[seen.code])
    return low, high, np.array(seen.group_probability, dtype=float, order="C")


def likelihood(
    model: CoupledTargets, particles: np.ndarray, seen: Any, compensated: bool = True
) -> np.ndarray:
    """p(y | x), (trials, nodes, particles), up to a factor a node where all would underflow."""
    trials, nodes, _, count = particles.shape
    particles, result = np.ascontiguousarray(particles), np.empty((trials, nodes, count))
    known = reading(model, seen, compensated), network(model)
    kernels.likelihoods(particles, *known, np.empty((3, count)), result)
    return result
