"""The elementary functions for arrays of any shape, for callers that are plain NumPy.

As NumPy's of the same name, but with the same bits on every machine: NumPy's differ between
CPUs by the last digit. `out` may be an argument itself; without it the result is a new array, or
a float of floats.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from repro.kernels import elementary, normal_probability
from repro.kernels.compiled import kernel


def _of_one(loop: Callable, x: ArrayLike, out: np.ndarray | None) -> Any:
    x = np.asarray(x, dtype=float)
    result = np.empty(x.shape) if out is None else out
    if result.shape != x.shape:
        raise ValueError(f"out has shape {result.shape}, not {x.shape}")
    flat = result.reshape(-1)
    loop(x.reshape(-1), flat)
    if not np.shares_memory(flat, result):
        result[...] = flat.reshape(x.shape)
    return result if out is not None or x.ndim else float(flat[0])


def _of_two(loop: Callable, x: ArrayLike, y: ArrayLike) -> Any:
    x, y = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
    result = np.empty(x.size)
    loop(np.ascontiguousarray(x).reshape(-1), np.ascontiguousarray(y).reshape(-1), result)
    return result.reshape(x.shape) if x.ndim else float(result[0])


@kernel
def _exp(x, out):
    for i in range(x.size):
        out[i] = elementary.exp(x[i])


def exp(x: ArrayLike, out: np.ndarray | None = None) -> Any:
    """e^x."""
    return _of_one(_exp, x, out)


@kernel
def _expm1(x, out):
    for i in range(x.size):
        out[i] = elementary.expm1(x[i])


def expm1(x: ArrayLike, out: np.ndarray | None = None) -> Any:
    """e^x - 1."""
    return _of_one(_expm1, x, out)


@kernel
def _log(x, out):
    for i in range(x.size):
        out[i] = elementary.log(x[i])


def log(x: ArrayLike, out: np.ndarray | None = None) -> Any:
    """Natural logarithm; -inf for zero, NaN below, without a warning."""
    return _of_one(_log, x, out)


@kernel
def _log10(x, out):
    for i in range(x.size):
        out[i] = elementary.log10(x[i])


def log10(x: ArrayLike, out: np.ndarray | None = None) -> Any:
    """Decimal logarithm; -inf for zero, NaN below, without a warning."""
    return _of_one(_log10, x, out)


@kernel
def _log1p(x, out):
    for i in range(x.size):
        out[i] = elementary.log1p(x[i])


def log1p(x: ArrayLike, out: np.ndarray | None = None) -> Any:
    """log(1 + x)."""
    return _of_one(_log1p, x, out)


@kernel
def _sin(x, out):
    for i in range(x.size):
        out[i] = elementary.sin(x[i])


def sin(x: ArrayLike, out: np.ndarray | None = None) -> Any:
    """Sine of angles in radians, NaN beyond a million."""
    return _of_one(_sin, x, out)


@kernel
def _cos(x, out):
    for i in range(x.size):
        out[i] = elementary.cos(x[i])


def cos(x: ArrayLike, out: np.ndarray | None = None) -> Any:
    """Cosine of angles in radians, NaN beyond a million."""
    return _of_one(_cos, x, out)


@kernel
def _normal_cdf(x, out):
    for i in range(x.size):
        out[i] = normal_probability.normal_cdf(x[i])


def normal_cdf(x: ArrayLike, out: np.ndarray | None = None) -> Any:
    """Standard normal probability below x."""
    return _of_one(_normal_cdf, x, out)


@kernel
def _log_normal_cdf(x, out):
    for i in range(x.size):
        out[i] = normal_probability.log_normal_cdf(x[i])


def log_normal_cdf(x: ArrayLike, out: np.ndarray | None = None) -> Any:
    """Logarithm of the standard normal probability below x."""
    return _of_one(_log_normal_cdf, x, out)


@kernel
def _arctan2(y, x, out):
    for i in range(x.size):
        out[i] = elementary.arctan2(y[i], x[i])


def arctan2(y: ArrayLike, x: ArrayLike) -> Any:
    """The angle of (x, y) in (-pi, pi]."""
    return _of_two(_arctan2, y, x)


@kernel
def _hypot(x, y, out):
    for i in range(x.size):
        out[i] = elementary.hypot(x[i], y[i])


def hypot(x: ArrayLike, y: ArrayLike) -> Any:
    """sqrt(x^2 + y^2)."""
    return _of_two(_hypot, x, y)


@kernel
def _logaddexp(x, y, out):
    for i in range(x.size):
        out[i] = elementary.logaddexp(x[i], y[i])


def logaddexp(x: ArrayLike, y: ArrayLike) -> Any:
    """log(e^x + e^y)."""
    return _of_two(_logaddexp, x, y)
