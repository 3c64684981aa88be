"""The recursion of the posterior Cramer-Rao bound of a linear motion (Tichavsky et al. 1998)."""

from repro.kernels.compiled import kernel
from repro.kernels.small_matrices import propagate


@kernel
def cramer_rao(transition, noise, start, informations, arrived, first, groups, out, scratch):
    """Bounds of the mean square errors, out (trials, steps, groups), of each arrival sequence.

    P <- F P F' + Q, then P <- (P^-1 + M)^-1 with M the sum of informations (steps, sensors, n, n)
    of the measurements that arrived (trials, steps, sensors); a study that begins with y(0) has
    first 0. groups (groups, n) has 1 for the components that an error is made up of. scratch
    (4, n, n).
    """
    p, work = scratch[0], scratch[1]
    trials, steps, sensors = arrived.shape
    n = len(transition)
    for trial in range(trials):
        copy(start, p)
        for k in range(steps):
            if k > 0:
                propagate(transition, p, noise, work, scratch[2])
                copy(scratch[2], p)
            if k >= first:
                total = scratch[3]
                total[:, :] = 0.0
                for s in range(sensors):
                    if arrived[trial, k, s]:
                        for i in range(n):
                            for j in range(n):
                                total[i, j] += informations[k, s, i, j]
                inform(p, total, work, scratch[2])
            for g in range(len(groups)):
                out[trial, k, g] = 0.0
                for i in range(n):
                    out[trial, k, g] += groups[g, i] * p[i, i]


@kernel
def copy(matrix, out):
    """out = matrix, without the room for a slice."""
    for i in range(len(matrix)):
        for j in range(len(matrix)):
            out[i, j] = matrix[i, j]


@kernel
def inform(p, information, system, right):
    """P <- (I + P M)^-1 P, which a singular P has too; Gauss and Jordan with pivots."""
    n = len(p)
    for i in range(n):
        for j in range(n):
            system[i, j] = 1.0 if i == j else 0.0
            for m in range(n):
                system[i, j] += p[i, m] * information[m, j]
            right[i, j] = p[i, j]
    for i in range(n):
        pivot = i
        for row in range(i + 1, n):
            if abs(system[row, i]) > abs(system[pivot, i]):
                pivot = row
        for j in range(n):
            system[i, j], system[pivot, j] = system[pivot, j], system[i, j]
            right[i, j], right[pivot, j] = right[pivot, j], right[i, j]
        scale = 1.0 / system[i, i]
        for j in range(n):
            system[i, j] *= scale
            right[i, j] *= scale
        for row in range(n):
            if row != i:
                factor = system[row, i]
                for j in range(n):
                    system[row, j] -= factor * system[i, j]
                    right[row, j] -= factor * right[i, j]
    for i in range(n):
        for j in range(n):
            p[i, j] = 0.5 * (right[i, j] + right[j, i])
