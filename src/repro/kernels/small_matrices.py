"""Products of small matrices of one system, (n, n)."""

from repro.kernels.compiled import kernel


@kernel
def quadratic(row, matrix):
    """row matrix row'."""
    total = 0.0
    for i in range(row.size):
        if row[i] != 0.0:
            for j in range(row.size):
                total += row[i] * matrix[i, j] * row[j]
    return total


@kernel
def propagate(a, symmetric, q, product, out):
    """A M A' + Q of a symmetric M; product: A M."""
    n = len(a)
    for i in range(n):
        for j in range(n):
            product[i, j] = 0.0
        for m in range(n):
            if a[i, m] != 0.0:
                for j in range(n):
                    product[i, j] += a[i, m] * symmetric[m, j]
    for i in range(n):
        for j in range(i + 1):
            total = q[i, j]
            for m in range(n):
                total += product[i, m] * a[j, m]
            out[i, j] = out[j, i] = total
