"""Whittaker smoother (discrete smoothing spline), its penalty chosen by risk: a core of ``auto``.

::

    min_f |z - f|^2 + lambda |D^d f|^2,    f = (I + lambda D'D)^-1 z
    Cp(lambda) = |z - f|^2 + 2 sigma^2 trace (I + lambda D'D)^-1

The matrix has 2d + 1 bands: its Cholesky factor is LAPACK's (scipy.linalg), and the diagonal of its
inverse comes from that factor exactly, in O(n d^2) (Hutchinson and de Hoog, Numer. Math. 47, 1985).
Polynomials of degree below d pass unchanged.

:func:`smooth_locally` chooses the penalty anew at every sample: the local risk, a Gaussian mean of
(z - f)^2 + 2 sigma^2 h_ii - sigma^2, weighs all penalties by exp(-15 (risk - least) / sigma^2).
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numba import njit
from numpy.typing import NDArray
from scipy.linalg import cho_solve_banded, cholesky_banded
from scipy.ndimage import gaussian_filter1d

from fpt_ros.denoising.offline import Signal

GRID = {2: np.logspace(-1, 10, 28), 3: np.logspace(-1, 10, 24)}
"""Penalties lambda tried for each order d; beyond them too few digits would be left of f."""

WIDTH = 20.0
"""Standard deviation of the window of the local risk [samples]."""
SHARPNESS = 15.0


def penalty_bands(n: int, order: int) -> Signal:
    """Upper bands of D'D, shape (order + 1, n), as LAPACK stores them: the diagonal is last."""
    taps = np.array([1.0])
    for _ in range(order):
        taps = np.convolve(taps, [1.0, -1.0])
    bands = np.zeros((order + 1, n))
    for shift in range(order + 1):
        for k in range(order + 1 - shift):
            # row r of D holds taps[k] at column r + k; n - order rows
            bands[order - shift, shift + k : shift + k + n - order] += taps[k] * taps[k + shift]
    return bands


@njit(cache=True)
def _inverse_diagonal(factor: Signal) -> Signal:
    """Diagonal of (U'U)^-1 for the banded upper factor U, shape (d + 1, n)."""
    d = factor.shape[0] - 1
    n = factor.shape[1]
    inverse = np.zeros((n + d, d + 1))  # [i, k] = inverse matrix at (i, i + k)
    leverage = np.empty(n)
    for i in range(n - 1, -1, -1):
        diagonal = factor[d, i]
        for k in range(d, -1, -1):
            total = 1.0 / (diagonal * diagonal) if k == 0 else 0.0
            for m in range(1, d + 1):
                if i + m >= n or i + k >= n:
                    break
                row, column = (i + m, i + k) if m <= k else (i + k, i + m)
                total -= factor[d - m, i + m] / diagonal * inverse[row, column - row]
            if i + k < n:
                inverse[i, k] = total
        leverage[i] = inverse[i, 0]
    return leverage


@dataclass(frozen=True)
class Smoothers:
    """All penalties of one order for one length.

    Attributes:
        factors: banded Cholesky factors of I + lambda D'D.
        leverages: diagonals of the inverses, shape (penalties, n).
        traces: their sums: the degrees of freedom.
    """

    factors: tuple[NDArray[np.float64], ...]
    leverages: Signal
    traces: tuple[float, ...]


@lru_cache(maxsize=8)
def smoothers(n: int, order: int) -> Smoothers:
    """The factors of every penalty of the grid for n > order samples."""
    bands = penalty_bands(n, order)
    factors, leverages = [], []
    for penalty in GRID[order]:
        matrix = penalty * bands
        matrix[-1] += 1.0
        factor = np.ascontiguousarray(cholesky_banded(matrix))
        factors.append(factor)
        leverages.append(_inverse_diagonal(factor))
    traces = tuple(float(leverage.sum()) for leverage in leverages)
    return Smoothers(tuple(factors), np.array(leverages), traces)


def smooth(z: Signal, sigma: float, order: int) -> tuple[Signal, float]:
    """The smooth curve of least Cp, shape (n,), and its degrees of freedom, trace + 1.

    Cp has one minimum in all but odd cases; the search goes down from the smoothest curve and ends
    where Cp has risen twice the noise of its own.
    """
    family = smoothers(len(z), order)
    best = np.inf
    estimate, df = z, float(len(z))
    slack = 8.0 * sigma**2
    for factor, trace in zip(family.factors[::-1], family.traces[::-1], strict=True):
        f = cho_solve_banded((factor, False), z, check_finite=False)
        cp = float(np.sum((z - f) ** 2)) + 2.0 * sigma**2 * trace
        if cp < best:
            best, estimate, df = cp, f, trace + 1.0
        elif 2.0 * sigma**2 * trace > best + slack:
            break
    return estimate, df


def smooth_locally(z: Signal, sigma: float, order: int) -> tuple[Signal, float]:
    """The curve whose penalty varies along the signal, shape (n,), and its degrees of freedom."""
    family = smoothers(len(z), order)
    curves = np.array(
        [cho_solve_banded((factor, False), z, check_finite=False) for factor in family.factors]
    )
    variance = sigma**2
    pointwise = (z - curves) ** 2 + variance * (2.0 * family.leverages - 1.0)
    risk = gaussian_filter1d(pointwise, WIDTH, axis=1, mode="reflect")
    weight = np.exp(-SHARPNESS * (risk - risk.min(axis=0)) / variance)
    weight /= weight.sum(axis=0)
    return np.sum(weight * curves, axis=0), float(np.sum(weight * family.leverages)) + 1.0
