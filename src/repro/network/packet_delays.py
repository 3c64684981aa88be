"""Consecutive packet losses and delays [packet_delays Sec. 2, (2)-(8)]."""

import numpy as np

LOST = -1  # delay of a step at which no packet arrives


def flags_per_step(bound: int, lossy: bool) -> int:
    """Number of arrival flags gamma_i(k) of a step: N by (2), one more if packets can be lost.

    N = 0 is a special case, lossy by definition: packet or noise [packet_delays Sec. 4.2.2].
    """
    return bound + 1 if lossy or bound == 0 else bound


def least_delay(bound: int, lossy: bool) -> int:
    """The least value of a delay: LOST where packets can be lost."""
    return 0 if flags_per_step(bound, lossy) == bound else LOST


def arrival_flags(uniforms: np.ndarray, arrival_probability: float) -> np.ndarray:
    """Flags gamma_i(k), 1 with the arrival probability, from one uniform each; any shape."""
    return (uniforms < arrival_probability).astype(float)


def delays(flags: np.ndarray, bound: int) -> np.ndarray:
    """Delay D(k) of the packet received at step k, from flags of shape (trials, flags, steps).

    D is the first i with gamma_i = 1. If there is none, D is N by (2), which has N flags; with
    one more flag the packet is LOST. Shape (trials, steps), integers.
    """
    without = bound if flags.shape[1] == bound else LOST
    return np.where(flags.any(axis=1), flags.argmax(axis=1), without)


def origins(delay: np.ndarray) -> np.ndarray:
    """Step whose measurement arrives at each step; negative where none does (lost or before 0)."""
    return np.where(delay == LOST, LOST, np.arange(delay.shape[-1]) - delay)


def value_without_packet(noise: np.ndarray, delay: np.ndarray) -> np.ndarray:
    """What y(k) is when no packet arrives: the noise v(k) (Sec. 4.2.2), or z(j) = 0 for j < 0."""
    return np.where(delay == LOST, noise, 0.0)


def received(measurement: np.ndarray, noise: np.ndarray, delay: np.ndarray) -> np.ndarray:
    """Received y(k) of (2) for one sensor; all arrays (trials, steps)."""
    origin = origins(delay)
    late = np.take_along_axis(measurement, np.maximum(origin, 0), axis=1)
    return np.where(origin >= 0, late, value_without_packet(noise, delay))


def mean_weights(arrival_probability: float, bound: int, rule: str = "sum to one") -> np.ndarray:
    """Mean weights alpha_0 ... alpha_N of Lemma 1, shape (N + 1,).

    `sum to one` reads (8b) for i < N and (8c) for i = N; `8b` reads (8b) for every i. For N = 0
    the weight is p in both (Nahi's channel, Sec. 4.2.2).
    """
    p = arrival_probability
    powers = np.cumprod([1.0] + [1 - p] * bound)  # of 1 - p
    weights = p * powers  # (8a), (8b)
    if bound > 0 and rule == "sum to one":
        weights[bound] = powers[bound]  # (8c)
    return weights
