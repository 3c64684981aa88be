"""Sparse matrices as rows, for Jacobians whose pattern is known: {column: entry}.

An entry is a number or an array over the batch (...); a column that is left out is always zero.
So a kernel that works through the entries pays nothing for zeros, and no product for ones.
"""

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

Rows = Sequence[Mapping[int, float | np.ndarray]]


def rows(matrix: ArrayLike) -> Rows:
    """Rows of a constant matrix (m, n)."""
    return [
        {j: float(entry) for j, entry in enumerate(row) if entry != 0} for row in np.asarray(matrix)
    ]


def as_rows(jacobian: Rows | np.ndarray) -> Rows:
    """Rows of a Jacobian that a model gives sparse, or dense as an array (..., m, n)."""
    if not isinstance(jacobian, np.ndarray):
        return jacobian
    if jacobian.ndim == 2:
        return rows(jacobian)
    m, n = jacobian.shape[-2:]
    return [{j: jacobian[..., i, j] for j in range(n)} for i in range(m)]


def dense(sparse: Rows | np.ndarray, batch: tuple[int, ...], columns: int) -> np.ndarray:
    """The matrices, (*batch, rows, columns)."""
    if isinstance(sparse, np.ndarray):
        return np.broadcast_to(sparse, (*batch, *sparse.shape[-2:]))
    matrix = np.zeros((*batch, len(sparse), columns))
    for i, row in enumerate(sparse):
        for j, entry in row.items():
            matrix[..., i, j] = entry
    return matrix


def combine(
    row: Mapping[int, float | np.ndarray],
    slabs: np.ndarray | Mapping[int, np.ndarray],
    out: np.ndarray,
) -> None:
    """out = sum of entry * slabs[column], elementwise, always in the same order, (...)."""
    ones = [j for j, entry in row.items() if isinstance(entry, float) and entry == 1.0]
    started = False
    for j, entry in row.items():
        if j in ones:
            continue
        if started:
            out += slabs[j] * entry
        else:
            np.multiply(slabs[j], entry, out=out)
            started = True
    for j in ones:
        if started:
            out += slabs[j]
        else:
            np.copyto(out, slabs[j])
            started = True
    if not started:
        out[...] = 0.0


def component(row: Mapping[int, float | np.ndarray]) -> int | None:
    """The column of a row that is 1 there and 0 elsewhere; None for any other row."""
    if len(row) == 1:
        ((column, entry),) = row.items()
        if isinstance(entry, float) and entry == 1.0:
            return column
    return None
