"""Energy-harvesting sensors: battery, Markov harvest, transmission probability.

A sensor transmits while its battery is not empty, which costs one unit of energy, and harvests
H(k) units at each step, where H is a Markov chain. All sensors have the same parameters and are
independent [energy_harvesting (5), (6)].
"""

from typing import Literal, NamedTuple

import numpy as np

TransmissionRule = Literal["lemma1", "exact"]


class EnergyQueue(NamedTuple):
    """The battery and the harvest of one sensor, as a filter knows them."""

    harvest_transition: np.ndarray  # Pi, (Hbar + 1, Hbar + 1), rows sum to one
    initial_harvest: np.ndarray  # law of H(0), (Hbar + 1,)
    initial_energy: int  # E(0)
    capacity: int  # Ebar


def initial_harvest(law: str, transition: np.ndarray) -> np.ndarray:
    """Law of H(0), (Hbar + 1,): `uniform`, `zero`, `full`, or `stationary` under `transition`."""
    units = len(transition)
    if law == "uniform":
        return np.full(units, 1 / units)
    if law in ("zero", "full"):
        return np.eye(units)[0 if law == "zero" else -1]
    # Where a uniform law tends to if H stays as it is at every other step, which changes no
    # stationary law and lets also a periodic chain converge.
    many_steps = (transition + np.eye(units)) / 2
    for _ in range(64):
        many_steps = (many_steps[:, :, None] * many_steps).sum(axis=1)
        many_steps /= many_steps.sum(axis=1, keepdims=True)
    return many_steps.mean(axis=0)


def harvest(uniforms: np.ndarray, queue: EnergyQueue) -> np.ndarray:
    """H(0), H(1), ... by inversion, one uniform each; the last axis is the step. Integers."""
    units = np.empty(uniforms.shape, dtype=int)
    first = np.cumsum(queue.initial_harvest)[:-1]
    units[..., 0] = (uniforms[..., :1] >= first).sum(axis=-1)
    bounds = np.cumsum(queue.harvest_transition, axis=1)[:, :-1]
    for k in range(1, uniforms.shape[-1]):
        units[..., k] = (uniforms[..., k, None] >= bounds[units[..., k - 1]]).sum(axis=-1)
    return units


def next_energy(energy: np.ndarray, harvested: np.ndarray, capacity: int) -> np.ndarray:
    """E(k+1) from E(k) and H(k+1): spend a unit if there is one, then harvest (6)."""
    return np.minimum(energy - (energy > 0) + harvested, capacity)


def energy(harvested: np.ndarray, queue: EnergyQueue) -> np.ndarray:
    """E(0), E(1), ... from H(0), H(1), ...; the last axis is the step. Integers."""
    levels = np.empty(harvested.shape, dtype=int)
    levels[..., 0] = queue.initial_energy
    for k in range(1, harvested.shape[-1]):
        levels[..., k] = next_energy(levels[..., k - 1], harvested[..., k], queue.capacity)
    return levels


def lemma_1(queue: EnergyQueue, steps: int) -> np.ndarray:
    """Law tau of E(k) for k = 0 ... steps, (steps + 1, Ebar + 1) [energy_harvesting Lemma 1].

    As printed: the laws of E(k-1) and H(k) are multiplied as if they were independent. Since H is
    a Markov chain, this is exact only if the rows of Pi are identical; `joint_chain` is exact.
    """
    top = queue.capacity
    chi = np.eye(top + 1)[top]
    law, tau = np.zeros(max(top, len(queue.initial_harvest))), np.zeros((steps + 1, top + 1))
    harvests = len(queue.initial_harvest)
    law[:harvests] = queue.initial_harvest
    tau[0, queue.initial_energy] = 1.0
    for k in range(1, steps + 1):
        law[:harvests] = _next_law(law[:harvests], queue.harvest_transition)  # p(k) of (24), (25)
        s = lemma_1_matrix(law, top)
        tau[k] = chi + (s * tau[k - 1]).sum(axis=1)  # (24)
    return tau


def lemma_1_matrix(law: np.ndarray, top: int) -> np.ndarray:
    """S(k) of Lemma 1, (top + 1, top + 1), from the law p(k) of H(k), at least (top,)."""
    s = np.zeros((top + 1, top + 1))
    for held in range(top + 1):
        left = max(held - 1, 0)
        s[left:top, held] = law[: top - left]
        s[top, held] = -s[:top, held].sum()
    return s


def joint_transition(queue: EnergyQueue) -> np.ndarray:
    """Transition matrix of the pair (E, H), which is state number E (Hbar + 1) + H."""
    units = len(queue.harvest_transition)
    e, h, drawn = np.meshgrid(
        np.arange(queue.capacity + 1), np.arange(units), np.arange(units), indexing="ij"
    )
    size = (queue.capacity + 1) * units
    chain = np.zeros((size, size))
    following = next_energy(e, drawn, queue.capacity) * units + drawn
    chain[e * units + h, following] = queue.harvest_transition[h, drawn]
    return chain


def initial_joint(queue: EnergyQueue) -> np.ndarray:
    """Law of (E(0), H(0)), ((Ebar+1)(Hbar+1),)."""
    energies = np.eye(queue.capacity + 1)[queue.initial_energy]
    return np.outer(energies, queue.initial_harvest).ravel()


def joint_chain(queue: EnergyQueue, steps: int) -> np.ndarray:
    """Exact law of (E(k), H(k)) for k = 0 ... steps, (steps + 1, Ebar + 1, Hbar + 1)."""
    chain, law = joint_transition(queue), initial_joint(queue)
    laws = [law]
    for _ in range(steps):
        law = _next_law(law, chain)
        laws.append(law)
    return np.stack(laws).reshape(steps + 1, queue.capacity + 1, -1)


def _next_law(law: np.ndarray, transition: np.ndarray) -> np.ndarray:
    """Law of a Markov chain one step later; in NumPy's own sums, as those of BLAS vary by CPU."""
    return (law[:, None] * transition).sum(axis=0)


def transmission_probability(queue: EnergyQueue, steps: int, rule: TransmissionRule) -> np.ndarray:
    """lambda(k) for k = 0 ... steps, (steps + 1,), by the rule `lemma1` or `exact` (26)."""
    if rule == "lemma1":
        return 1.0 - lemma_1(queue, steps)[:, 0]
    return 1.0 - joint_chain(queue, steps)[:, 0].sum(axis=1)
