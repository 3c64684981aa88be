"""Jacobians as sparse rows, for those whose pattern is known: {column: entry}.

An entry is a number or an array over the batch (...); a column that is left out is always zero.
So a kernel that works through the entries pays nothing for zeros.
"""

from collections.abc import Mapping, Sequence
from functools import lru_cache

import numpy as np

Rows = Sequence[Mapping[int, float | np.ndarray]]
Jacobian = Rows | np.ndarray  # (m, n) if the same for all systems, else (..., m, n)
# As kernels have it (repro.kernels.kalman_step): columns, weights, places, ends, slabs.
Pattern = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]
Terms = tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray]


def dense(jacobian: Jacobian, batch: tuple[int, ...], columns: int) -> np.ndarray:
    """The matrices, (*batch, rows, columns)."""
    if isinstance(jacobian, np.ndarray):
        return np.broadcast_to(jacobian, (*batch, *jacobian.shape[-2:]))
    matrix = np.zeros((*batch, len(jacobian), columns))
    for i, row in enumerate(jacobian):
        for j, entry in row.items():
            matrix[..., i, j] = entry
    return matrix


def terms(jacobian: Jacobian, systems: int) -> Terms:
    """The terms of each row of a Jacobian of so many systems."""
    if isinstance(jacobian, np.ndarray):
        m, n = jacobian.shape[-2:]
        if jacobian.ndim == 2:
            return _of_constants(jacobian.astype(float).tobytes(), m)
        slabs = np.array(jacobian.reshape(systems, m * n).T, dtype=float, order="C")
        return *_of_pattern((tuple((j, None) for j in range(n)),) * m), slabs
    pattern, varying = [], []
    for row in jacobian:
        entries = [
            (j, None if getattr(entry, "ndim", 0) else float(entry)) for j, entry in row.items()
        ]
        varying += [row[j] for j, constant in entries if constant is None]
        pattern.append(tuple(entries))
    return *_of_pattern(tuple(pattern)), np.array(varying, dtype=float, ndmin=2)


@lru_cache
def terms_of_covariance(entries: bytes, n: int) -> Terms:
    """Of the matrix that takes a packed covariance Sigma to A Sigma A', A (n, n) constant."""
    a = np.frombuffer(entries).reshape(n, n)
    upper = list(zip(*np.triu_indices(n), strict=True))
    lifted = [
        [a[i, p] * a[j, q] + (a[i, q] * a[j, p] if p != q else 0.0) for p, q in upper]
        for i, j in upper
    ]
    return terms(np.array(lifted), 0)


@lru_cache
def _of_constants(entries: bytes, m: int) -> Terms:
    matrix = np.frombuffer(entries).reshape(m, -1)
    return terms([{int(j): row[j] for j in np.flatnonzero(row)} for row in matrix], 0)


@lru_cache
def _of_pattern(rows: tuple[tuple[tuple[int, float | None], ...], ...]) -> Pattern:
    """Columns, weights, places and ends of rows of (column, constant, or None if it varies).

    Constants come first, filled up with zeros to a multiple of four.
    """
    found, slabs = [], 0
    for row in rows:
        of_row = [(j, constant, -1) for j, constant in row if constant is not None]
        of_row += [(0, 0.0, -1)] * (-len(of_row) % 4)
        ends = [len(of_row)]
        for j in [j for j, constant in row if constant is None]:
            of_row.append((j, 0.0, slabs))
            slabs += 1
        found.append((of_row, [*ends, len(of_row)]))
    width = max(len(of_row) for of_row, _ in found)
    columns, places = np.zeros((2, len(rows), width), dtype=np.int64)
    weights = np.zeros(columns.shape)
    for i, (of_row, _) in enumerate(found):
        for t, term in enumerate(of_row):
            columns[i, t], weights[i, t], places[i, t] = term
    return columns, weights, places, np.array([ends for _, ends in found])
