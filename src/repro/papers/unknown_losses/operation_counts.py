"""[unknown_losses Algorithms 1-3] as printed, one system and one product at a time, counted.

Table I is counted here, and tests compare the batched filters with it: plain matrix algebra, for
one trial. Linearisation is not counted, as in the paper.
"""

from typing import Any, NamedTuple

import numpy as np

from repro.models import Model

Update = tuple[np.ndarray, np.ndarray]  # xh(k|k) and Sigma(k|k)


class Linearised(NamedTuple):
    """The system (3) at one step: measurement at the prediction, and the step to the next."""

    innovation: np.ndarray  # y - h(xh(k|k-1)), (m,)
    measurement: np.ndarray  # C, (m, n)
    noise: np.ndarray  # R
    received: np.ndarray  # y, (m,)


class Operations:
    """Matrix products and Gaussian densities, computed and counted."""

    def __init__(self) -> None:
        self.products = self.densities = 0

    def product(self, left: np.ndarray, right: np.ndarray) -> np.ndarray:
        """left @ right."""
        self.products += 1
        return left @ right

    def log_density(self, value: np.ndarray, covariance: np.ndarray) -> float:
        """log N(value; 0, covariance) without its factor of 2 pi."""
        self.densities += 1
        distance = value @ np.linalg.solve(covariance, value)
        return -0.5 * (distance + np.linalg.slogdet(covariance)[1])

    def gain(
        self, covariance: np.ndarray, at: Linearised
    ) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """K of (4), Sigma C' and S: three products."""
        cross = self.product(covariance, at.measurement.T)
        s = self.product(at.measurement, cross) + at.noise
        return self.product(cross, np.linalg.inv(s)), cross, s

    def update(
        self,
        estimate: np.ndarray,
        covariance: np.ndarray,
        at: Linearised,
        gain: np.ndarray,
        cross: np.ndarray,
        weight: float,
    ) -> Update:
        """(4) with the weight for gamma: two products."""
        return (
            estimate + weight * self.product(gain, at.innovation[:, None])[:, 0],
            covariance - weight * self.product(gain, cross.T),
        )

    def time_update(self, covariance, transition: np.ndarray, noise: np.ndarray) -> np.ndarray:
        """Sigma of (5): two products."""
        return self.product(self.product(transition, covariance), transition.T) + noise


def iekf(
    operations: Operations,
    estimate: np.ndarray,
    covariance: np.ndarray,
    at: Linearised,
    gamma: float,
) -> Update:
    """Measurement update (4)."""
    gain, cross, _ = operations.gain(covariance, at)
    return operations.update(estimate, covariance, at, gain, cross, gamma)


def bkf_1(
    operations: Operations,
    estimate: np.ndarray,
    covariance: np.ndarray,
    at: Linearised,
    prior: float,
) -> Update:
    """Algorithm 1, steps 2 and 3."""
    gain, cross, s = operations.gain(covariance, at)
    arrived = operations.log_density(at.innovation, s) + np.log(prior)
    lost = operations.log_density(at.received, at.noise) + np.log(1 - prior)
    return operations.update(estimate, covariance, at, gain, cross, float(arrived > lost))


def bkf_2(
    operations: Operations,
    estimate: np.ndarray,
    covariance: np.ndarray,
    at: Linearised,
    prior: float,
) -> Update:
    """Algorithm 2, step 2."""
    gain, cross, s = operations.gain(covariance, at)
    arrived = np.log(prior) + operations.log_density(at.innovation, s)
    lost = np.log(1 - prior) + operations.log_density(at.received, at.noise)
    weight = np.exp(arrived - np.logaddexp(arrived, lost))
    correction = operations.product(gain, at.innovation[:, None])
    spread = operations.product(correction, operations.product(at.innovation[None, :], gain.T))
    estimate = estimate + weight * correction[:, 0]
    reduced = covariance - weight * operations.product(gain, cross.T)
    return estimate, reduced + weight * (1 - weight) * spread


def rbpf_particle(
    operations: Operations,
    estimate: np.ndarray,
    covariance: np.ndarray,
    at: Linearised,
    gamma: float,
) -> tuple[float, np.ndarray, np.ndarray]:
    """Algorithm 3 for one particle: what its log weight gains (2b), and its update (4a)."""
    gain, cross, s = operations.gain(covariance, at)
    if gamma == 1:
        gained = operations.log_density(at.innovation, s)
    else:
        gained = operations.log_density(at.received, at.noise)
    return gained, *operations.update(estimate, covariance, at, gain, cross, gamma)


def counted(model: Model, particles: int) -> dict[str, Operations]:
    """Operations of one iteration of each filter on a system of the model's size.

    The values of states and measurements are arbitrary: the products are the same for all.
    """
    n, m = len(model.initial_mean), len(model.measurement_covariance)
    estimate, covariance = np.zeros(n), np.eye(n)
    at = Linearised(np.ones(m), np.eye(m, n), np.eye(m), np.ones(m))
    steps = {
        "iekf": lambda count: iekf(count, estimate, covariance, at, 1.0),
        "bkf_1": lambda count: bkf_1(count, estimate, covariance, at, 0.5),
        "bkf_2": lambda count: bkf_2(count, estimate, covariance, at, 0.5),
        "rbpf": lambda count: rbpf_particle(count, estimate, covariance, at, 1.0),
    }
    counts = {name: Operations() for name in steps}
    for name, step in steps.items():
        for _ in range(particles if name == "rbpf" else 1):
            step(counts[name])
            counts[name].time_update(covariance, np.eye(n), np.eye(n))
    return counts


def table_1(model: Model, particles: int) -> list[dict[str, Any]]:
    """Rows of Table I, counted in one iteration of each filter."""
    return [
        {"study": "complexity", "point": f"particles={particles}", "filter": name}
        | {"metric": "operations", "component": component, "value": value}
        | {"mcse": 0.0, "trials": 1}
        for name, count in counted(model, particles).items()
        for component, value in (("densities", count.densities), ("products", count.products))
    ]
