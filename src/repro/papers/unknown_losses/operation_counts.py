"""[unknown_losses Algorithms 1-3] as printed, one system and one product at a time, counted.

Table I is counted here, and tests compare the batched filters with it: plain matrix algebra, for
one trial. Linearisation is not counted, as in the paper. The paper does not say how it counts. Here
a product counts if both of its factors are matrices, not one with a vector such as K e; products
are formed as the equations print them, but Sigma C' of (4), printed twice, once.
"""

from typing import Any, NamedTuple

import numpy as np

from repro.kernels import arrays

MANY_STATES = 100  # so many that the terms of the highest order are nearly all
Update = tuple[np.ndarray, np.ndarray]  # xh(k|k) and Sigma(k|k)


class Linearised(NamedTuple):
    """The system (3) at one step: measurement at the prediction, and the step to the next."""

    innovation: np.ndarray  # y - h(xh(k|k-1)), (m,)
    measurement: np.ndarray  # C, (m, n)
    noise: np.ndarray  # R
    received: np.ndarray  # y, (m,)


class Operations:
    """Matrix products, the multiplications in them, and Gaussian densities, as they are done."""

    def __init__(self) -> None:
        self.products = self.multiplications = self.densities = 0

    def product(self, left: np.ndarray, right: np.ndarray) -> np.ndarray:
        """left @ right of two matrices."""
        self.products += 1
        self.multiplications += left.shape[0] * left.shape[1] * right.shape[1]
        return left @ right

    def log_density(self, value: np.ndarray, covariance: np.ndarray) -> float:
        """log N(value; 0, covariance) without its factor of 2 pi."""
        self.densities += 1
        distance = value @ np.linalg.solve(covariance, value)
        return -0.5 * (distance + np.linalg.slogdet(covariance)[1])

    def gain(self, covariance: np.ndarray, at: Linearised) -> tuple[np.ndarray, np.ndarray]:
        """K = Sigma C' S^-1 of (4), and S = C Sigma C' + R: three products."""
        cross = self.product(covariance, at.measurement.T)
        s = self.product(at.measurement, cross) + at.noise
        return self.product(cross, np.linalg.inv(s)), s

    def update(
        self,
        estimate: np.ndarray,
        covariance: np.ndarray,
        at: Linearised,
        gain: np.ndarray,
        weight: float,
    ) -> Update:
        """(4) with the weight for gamma: two products."""
        reduction = self.product(self.product(gain, at.measurement), covariance)  # K C Sigma
        return estimate + weight * (gain @ at.innovation), covariance - weight * reduction

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
    gain, _ = operations.gain(covariance, at)
    return operations.update(estimate, covariance, at, gain, gamma)


def bkf_1(
    operations: Operations,
    estimate: np.ndarray,
    covariance: np.ndarray,
    at: Linearised,
    prior: float,
) -> Update:
    """Algorithm 1, steps 2 and 3."""
    gain, s = operations.gain(covariance, at)
    arrived = operations.log_density(at.innovation, s) + np.log(prior)
    lost = operations.log_density(at.received, at.noise) + np.log(1 - prior)
    return operations.update(estimate, covariance, at, gain, float(arrived > lost))


def bkf_2(
    operations: Operations,
    estimate: np.ndarray,
    covariance: np.ndarray,
    at: Linearised,
    prior: float,
) -> Update:
    """Algorithm 2, step 2."""
    gain, s = operations.gain(covariance, at)
    arrived = np.log(prior) + operations.log_density(at.innovation, s)
    lost = np.log(1 - prior) + operations.log_density(at.received, at.noise)
    weight = np.exp(arrived - np.logaddexp(arrived, lost))
    estimate, reduced = operations.update(estimate, covariance, at, gain, weight)  # (12)
    squared = np.outer(at.innovation, at.innovation)
    spread = operations.product(operations.product(gain, squared), gain.T)  # K e e' K' of (13)
    return estimate, reduced + weight * (1 - weight) * spread


def rbpf_particle(
    operations: Operations,
    estimate: np.ndarray,
    covariance: np.ndarray,
    at: Linearised,
    gamma: float,
) -> tuple[float, np.ndarray, np.ndarray]:
    """Algorithm 3 for one particle: what its log weight gains (2b), and its update (4a)."""
    gain, s = operations.gain(covariance, at)
    if gamma == 1:
        gained = operations.log_density(at.innovation, s)
    else:
        gained = operations.log_density(at.received, at.noise)
    return gained, *operations.update(estimate, covariance, at, gain, gamma)


def counted(n: int, m: int, particles: int) -> dict[str, Operations]:
    """Operations of one iteration of each filter with n states and m measurements.

    Their values are arbitrary: what is done does not depend on them.
    """
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


def order(few: int, many: int, factor: float = 2.0) -> float:
    """Of a cost: by which power of the factor it grows."""
    return arrays.log(many / few) / arrays.log(factor)


def table_1(n: int, m: int, particles: int) -> list[dict[str, Any]]:
    """Rows of Table I, counted in one iteration of each filter with n states, m measurements.

    The orders are those by which the multiplications grow from many states to twice as many, and
    the products of the RBPF from its particles to twice as many.
    """
    counts = counted(n, m, particles)
    large, larger = counted(MANY_STATES, m, 1), counted(2 * MANY_STATES, m, 1)
    numbers = [
        number
        for name, count in counts.items()
        for number in (
            (name, "densities", count.densities),
            (name, "products", count.products),
            (name, "order_in_n", order(large[name].multiplications, larger[name].multiplications)),
        )
    ]
    twice = counted(n, m, 2 * particles)["rbpf"].products
    numbers.append(("rbpf", "order_in_particles", order(counts["rbpf"].products, twice)))
    where = {"study": "complexity", "point": f"particles={particles}", "metric": "operations"}
    return [
        where | {"filter": name, "component": component, "value": value, "mcse": 0.0, "trials": 1}
        for name, component, value in numbers
    ]
