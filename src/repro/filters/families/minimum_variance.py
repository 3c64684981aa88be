"""Gain and covariance shared by OMVF (13)-(17) and EMVF (24)-(27) (Liu, Xu, Shi 2012).

Scalar measurement. Leading axes are free: none for the linear filter, trials for the nonlinear.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np


class Gain(NamedTuple):
    gain: np.ndarray  # K, (..., n)
    row: np.ndarray  # J of (16), (..., n)
    rows: list[np.ndarray]  # J_0, J_1, ... of the terms of (16) without their weights
    noise_variance: np.ndarray  # Qbar + Rbar, (...)
    innovation_variance: np.ndarray  # the bracket of (14), (...)


def quadratic(row: np.ndarray, matrix: np.ndarray) -> np.ndarray:
    """row matrix row', shape (...)."""
    return np.vecdot(np.matvec(matrix, row), row)


def measurement_rows(
    rows: Sequence[np.ndarray],
    transition: np.ndarray,
    inverses: Sequence[np.ndarray],
    process_covariance: np.ndarray,
) -> tuple[list[np.ndarray], list[np.ndarray]]:
    """Rows J_i of (16), which refer z(k+1-i) to x(k), and the terms of Qbar, weights left out.

    rows: C(k+1), C(k), C(k-1) ...; inverses: A(k-1)^-1, A(k-2)^-1 ... as far as rows reach.
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

    `measurement_spread` replaces Sbar - J S J' by another variance of h over the delays (the
    `matched` reading); `qbar_sign` is the sign of Qbar's terms i >= 2 (+1 as printed).
    A variance that is not positive and finite gives the gain 0, hence no update.
    """
    referred, spread = measurement_rows(rows, transition, inverses, process_covariance)
    weights = weights[: len(referred)]
    row = sum(weight * term for weight, term in zip(weights, referred, strict=True))  # (16)
    signs = [1] * min(2, len(spread)) + [qbar_sign] * (len(spread) - 2)
    qbar = sum(s * w * term for s, w, term in zip(signs, weights, spread, strict=True))
    # N = 0 carries noise whether or not the packet arrives: Rbar = R, not p R.
    rbar = measurement_variance * (weights.sum() if len(weights) > 1 else 1.0)
    if measurement_spread is None:
        # Sbar - J S J' in one sum: its two parts cancel terms of the size of S.
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
    return Gain(np.where(usable[..., None], value, 0.0), row, referred, qbar + rbar, variance)


def covariance_update(
    step: Gain,
    first_row: np.ndarray,
    transition: np.ndarray,
    first_weight: float,
    covariance: np.ndarray,
    process_covariance: np.ndarray,
) -> np.ndarray:
    """P(k+1|k+1) of (15) and (25), symmetrised: the printed form is not symmetric in rounding."""
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
    """S(k+1) of (17) and (27)."""
    return transition @ second_moment @ np.swapaxes(transition, -1, -2) + process_covariance
