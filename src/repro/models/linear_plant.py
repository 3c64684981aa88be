"""The linear example [packet_delays (37)-(38)]."""

import numpy as np

from repro.kernels import arrays


def transition_matrix(k: int, sine_period: float) -> np.ndarray:
    """A(k) of (37), (2, 2). With the printed period 2 the sine is 0 (to 1e-16 k) at every k."""
    return np.array([[0.8, 0.0], [0.2 * arrays.sin(2 * k * np.pi / sine_period), 0.95]])


def trajectory(x0: np.ndarray, noise: np.ndarray, sine_period: float) -> np.ndarray:
    """States (trials, steps + 1, 2) from x(0) = x0 and process noise w of (trials, steps, 2)."""
    states = np.empty((noise.shape[0], noise.shape[1] + 1, 2))
    states[:, 0] = x0
    for k in range(noise.shape[1]):
        moved = (transition_matrix(k, sine_period) * states[:, k, None]).sum(axis=-1)
        states[:, k + 1] = moved + noise[:, k]
    return states
