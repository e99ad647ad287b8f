"""The banded least squares of a penalty that varies along the signal.

::

    A = W + L' diag(precision) L,    f = A^-1 W z,    W = diag(weight)

L has d + 1 taps in each of its n - d rows, so A has 2d + 1 bands: f, the diagonal of A^-1 and that
of L A^-1 L' take O(n d^2) (Hutchinson and de Hoog, Numer. Math. 47, 1985).
"""

import numpy as np
from numba import njit

from fpt_ros.denoising.offline import Signal


@njit(cache=True, fastmath=True)
def _factor(precision: Signal, rows: Signal, weight: Signal) -> tuple[Signal, Signal]:
    """A = U' diag(pivot) U: the superdiagonals k of U at [i, k], shape (n, d + 1), and pivot."""
    d = rows.shape[1] - 1
    n = rows.shape[0] + d
    upper = np.zeros((n, d + 1))
    upper[:, 0] = weight
    for r in range(n - d):
        for a in range(d + 1):
            for b in range(a, d + 1):
                upper[r + a, b - a] += precision[r] * rows[r, a] * rows[r, b]
    pivot = np.empty(n)
    for i in range(n):
        for k in range(min(d, n - 1 - i) + 1):
            total = upper[i, k]
            for m in range(1, min(d - k, i) + 1):
                total -= upper[i - m, m] * upper[i - m, m + k] * pivot[i - m]
            if k == 0:
                pivot[i] = total
            else:
                upper[i, k] = total / pivot[i]
    return upper, pivot


@njit(cache=True, fastmath=True)
def solve(
    z: Signal, precision: Signal, rows: Signal, weight: Signal
) -> tuple[Signal, Signal, Signal, float]:
    """f, L f, the diagonal of L A^-1 L', and the trace of A^-1 W.

    Args:
        z: samples, shape (n,).
        precision: shape (n - d,).
        rows: taps of L, row r from column r on, shape (n - d, d + 1).
        weight: of each sample, shape (n,).
    """
    upper, pivot = _factor(precision, rows, weight)
    n, d = len(z), rows.shape[1] - 1
    f = np.empty(n)
    for i in range(n):
        f[i] = weight[i] * z[i]
        for m in range(1, min(d, i) + 1):
            f[i] -= upper[i - m, m] * f[i - m]
    inverse = np.zeros((n, d + 1))  # [i, k] = A^-1 at (i, i + k)
    trace = 0.0
    for i in range(n - 1, -1, -1):
        f[i] /= pivot[i]
        reach = min(d, n - 1 - i)
        for m in range(1, reach + 1):
            f[i] -= upper[i, m] * f[i + m]
        for k in range(reach, -1, -1):
            total = 1.0 / pivot[i] if k == 0 else 0.0
            for m in range(1, reach + 1):
                row, column = (m, k) if m <= k else (k, m)
                total -= upper[i, m] * inverse[i + row, column - row]
            inverse[i, k] = total
        trace += weight[i] * inverse[i, 0]
    rough, doubt = np.zeros(n - d), np.zeros(n - d)
    for r in range(n - d):
        for a in range(d + 1):
            rough[r] += rows[r, a] * f[r + a]
            doubt[r] += rows[r, a] ** 2 * inverse[r + a, 0]
            for b in range(a + 1, d + 1):
                doubt[r] += 2.0 * rows[r, a] * rows[r, b] * inverse[r + a, b - a]
    return f, rough, doubt, trace
