"""Gain and covariance of OMVF [packet_delays (13)-(17)] and EMVF [packet_delays (24)-(27)].

The measurement is a scalar. Leading axes are free: none for the linear filter, the trials for the
nonlinear one.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np


class Gain(NamedTuple):
    """The gain of one step and what it is computed from."""

    gain: np.ndarray  # K, (..., n)
    row: np.ndarray  # J of (16), (..., n)


def quadratic(row: np.ndarray, matrix: np.ndarray) -> np.ndarray:
    """row matrix row', shape (...)."""
    return np.vecdot(np.matvec(matrix, row), row)


def measurement_rows(
    rows: Sequence[np.ndarray],
    transition: np.ndarray,
    inverses: Sequence[np.ndarray],
    process_covariance: np.ndarray,
) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Rows J_i of (16), which express z(k+1-i) by x(k), and the terms of Qbar, without weights.

    rows: C(k+1), C(k), C(k-1), ..., (..., n) each; inverses: A(k-1)^-1, A(k-2)^-1, ...,
    (..., n, n) each, one for every row after the second.
    """
    referred = [np.vecmat(rows[0], transition)]
    spread = [quadratic(rows[0], process_covariance)]
    for i, row in enumerate(rows[1:], start=1):
        total = np.zeros(row.shape[:-1])
        for inverse in reversed(inverses[: i - 1]):  # A(k+1-i)^-1 first, A(k-1)^-1 last, by (18)
            row = np.vecmat(row, inverse)
            total = total + quadratic(row, process_covariance)
        referred.append(row)
        spread.append(total)
    return referred, spread


def gain(
    rows: Sequence[np.ndarray],
    transition: np.ndarray,
    inverses: Sequence[np.ndarray],
    weights: np.ndarray,
    covariance: np.ndarray,
    second_moment: np.ndarray,
    process_covariance: np.ndarray,
    measurement_variance: float,
    qbar_sign: int = 1,
    measurement_spread: np.ndarray | None = None,
) -> Gain:
    """Gain (14) of y(k+1) from P(k|k), S(k) and the rows C(k+1-i) of the terms that exist.

    rows and inverses are as in `measurement_rows`; weights are alpha_0, alpha_1, ....
    `measurement_spread` replaces Sbar - J S J' by another variance of h over the delays (the
    reading `matched`); `qbar_sign` is the sign of the terms i >= 2 of Qbar (+1 as printed).
    If the variance is not positive or the gain not finite, the gain is 0: no update.
    """
    referred, spread = measurement_rows(rows, transition, inverses, process_covariance)
    weights = weights[: len(referred)]
    row = np.sum([w * term for w, term in zip(weights, referred, strict=True)], axis=0)  # (16)
    signs = [1] * min(2, len(spread)) + [qbar_sign] * (len(spread) - 2)
    qbar = sum(s * w * term for s, w, term in zip(signs, weights, spread, strict=True))
    # With N = 0 there is noise whether or not the packet arrives: Rbar = R, not p R.
    rbar = measurement_variance * (weights.sum() if len(weights) > 1 else 1.0)
    if measurement_spread is None:
        # Sbar - J S J' at once: the two cancel to a small difference of terms as large as S.
        sbar = sum(
            w * quadratic(term, second_moment) for w, term in zip(weights, referred, strict=True)
        )
        measurement_spread = np.maximum(sbar - quadratic(row, second_moment), 0.0)
        uncertainty = quadratic(row, covariance)
    else:
        uncertainty = sum(
            w * quadratic(term, covariance) for w, term in zip(weights, referred, strict=True)
        )
    variance = uncertainty + measurement_spread + qbar + rbar
    cross = np.matvec(transition, np.matvec(covariance, row))
    cross = cross + weights[0] * np.matvec(process_covariance, rows[0])
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        value = cross / variance[..., None]  # (14)
    usable = (variance > 0) & np.isfinite(value).all(axis=-1)
    return Gain(np.where(usable[..., None], value, 0.0), row)


def covariance_update(
    step: Gain,
    first_row: np.ndarray,
    transition: np.ndarray,
    first_weight: float,
    covariance: np.ndarray,
    process_covariance: np.ndarray,
) -> np.ndarray:
    """P(k+1|k+1) of (15) and (25), (..., n, n).

    Symmetrised: rounding makes the printed form unsymmetric.
    """
    reduced = transition - step.gain[..., :, None] * step.row[..., None, :]  # F of (13)
    correction = (
        process_covariance
        - first_weight
        * step.gain[..., :, None]
        * (np.vecmat(first_row, process_covariance)[..., None, :])
    )
    updated = reduced @ covariance @ np.swapaxes(transition, -1, -2) + correction
    return (updated + np.swapaxes(updated, -1, -2)) / 2


def second_moment_update(
    transition: np.ndarray, second_moment: np.ndarray, process_covariance: np.ndarray
) -> np.ndarray:
    """S(k+1) of (17) and (27), (..., n, n)."""
    return transition @ second_moment @ np.swapaxes(transition, -1, -2) + process_covariance
