"""Sums of few sinusoids on a constant: a core of ``auto``.

Greedy: the largest peak of the 8 times zero-padded spectrum of the residual becomes a tone, then
Gauss-Newton steps on the frequencies of all tones (amplitudes by least squares in the same system),
until a tone lowers n ln(RSS) by less than 4 ln n.
"""

import math
from dataclasses import dataclass, field

import numpy as np
import scipy.fft
from numba import njit
from numpy.typing import NDArray

from fpt_ros.denoising.offline import Sigma, Signal, scale_and_weight

PADDING = 8
STEPS = 6
MOST = 12
"""Tones at most: what needs more is no sum of few sinusoids."""
BIC = 4.0
"""Least gain of a tone in units of ln n: 3 for its parameters alike; 5 if its frequency, whose
error falls as n^-1.5, counts threefold (Djuric, IEEE Trans. Signal Processing 44, 1996). At 3,
noise alone has a tone in some 3 % of records, and EM then keeps it."""
ENOUGH = 0.75
"""Share of the noise's power below which a residual is all noise, whatever tones it has: the error
of rounding a tone is tones."""
DF = 6.0
"""Degrees of freedom of a tone: 3, and 3 for the choice of its peak."""


@njit(cache=True)
def _fit(z: Signal, root: Signal, omega: Signal, steps: int, constant: bool) -> Signal:
    """Gauss-Newton on ``omega`` [rad/sample], changed in place; returns the fitted sum.

    Residuals count ``root`` times. Columns: 1, and for each tone cos, sin and the derivative by
    frequency. Time runs from the middle of the record to keep the columns nearly orthogonal.
    """
    n, k = len(z), len(omega)
    middle = 0.5 * (n - 1)
    f = np.zeros(n)
    amplitude = np.zeros((k, 2))
    for step in range(steps + 1):
        wide = step > 0 and step < steps + 1
        width = 3 if wide else 2
        size = 1 + width * k
        columns = np.empty((size, n))
        columns[0] = 1.0 if constant else 0.0
        for j in range(k):
            c, s = math.cos(omega[j]), math.sin(omega[j])
            x, y = math.cos(-omega[j] * middle), math.sin(-omega[j] * middle)
            row = 1 + width * j
            for i in range(n):
                columns[row, i] = x
                columns[row + 1, i] = y
                if wide:
                    time = (i - middle) / middle
                    columns[row + 2, i] = time * (amplitude[j, 1] * x - amplitude[j, 0] * y)
                x, y = x * c - y * s, x * s + y * c
        for j in range(size):
            for i in range(n):
                columns[j, i] *= root[i]
        gram = columns @ columns.T
        for i in range(size):
            gram[i, i] += 1e-9 * n
        solution = np.linalg.solve(gram, columns @ (root * z))
        for j in range(k):
            row = 1 + width * j
            amplitude[j, 0], amplitude[j, 1] = solution[row], solution[row + 1]
            if wide and step < steps:
                change = solution[row + 2] / middle
                limit = 0.5 * math.pi / n
                omega[j] += min(max(change, -limit), limit)
                omega[j] = min(max(omega[j], 0.25 * math.pi / n), math.pi)
        if step == steps:
            f = (solution @ columns) / root
    return f


def _peak(residual: Signal) -> float:
    """Frequency [rad/sample] of the largest peak of the zero-padded spectrum."""
    n = scipy.fft.next_fast_len(PADDING * len(residual), real=True)
    spectrum = np.abs(scipy.fft.rfft(residual - residual.mean(), n))
    return float(2.0 * np.pi * max(int(np.argmax(spectrum)), PADDING // 4) / n)


def fit(
    z: Signal,
    omega: NDArray[np.float64],
    most: int = MOST,
    weight: Signal | None = None,
    sigma: float = 0.0,
) -> tuple[Signal, NDArray[np.float64]]:
    """The sum of tones, shape (n,), and their frequencies [rad/sample].

    Args:
        z: samples, shape (n,).
        omega: frequencies to begin with; more are added while BIC allows.
        most: tones at most.
        weight: of each squared residual, shape (n,); default: 1.
        sigma: of the noise where the weight is 1: no tone is added to less than ``ENOUGH`` of it.
    """
    n = len(z)
    root = np.ones(n) if weight is None else np.sqrt(weight)

    def rss_of(f: Signal) -> float:
        return float(np.sum((root * (z - f)) ** 2))

    size = 2.0 ** math.frexp(float(np.std(z)))[1]  # the columns of _fit are of order 1
    z = np.ascontiguousarray(z) / size
    tones = omega.copy()
    f = _fit(z, root, tones, 2, True) if len(tones) else np.full(n, np.average(z, weights=root**2))
    rss = rss_of(f)
    enough = ENOUGH * n * (sigma / size) ** 2
    while len(tones) < min(most, n // 8) and rss > enough:
        more = np.append(tones, _peak(root**2 * (z - f)))
        g = _fit(z, root, more, STEPS, True)
        lower = rss_of(g)
        if lower <= 0.0 or n * math.log(rss / lower) < BIC * math.log(n):
            break
        tones, f, rss = more, g, lower
    if len(tones):
        without = tones.copy()
        g = _fit(z, root, without, 2, False)
        if n * math.log(rss_of(g) / max(rss, 1e-300)) < math.log(n):
            return size * g, without
    return size * f, tones


@dataclass
class Tones:
    """The core with the memory of its tones, so that every round of EM begins where the last ended.

    Attributes:
        omega: frequencies of the tones [rad/sample].
        enough: whether no tone is added to a residual below the noise: if that is of rounding.
    """

    omega: NDArray[np.float64] = field(default_factory=lambda: np.empty(0))
    enough: bool = False

    def smooth(self, z: Signal, sigma: Sigma) -> tuple[Signal, float]:
        """The sum of tones, shape (n,), and its degrees of freedom."""
        typical, weight = scale_and_weight(sigma, len(z))
        f, self.omega = fit(z, self.omega, weight=weight, sigma=typical if self.enough else 0.0)
        return f, 1.0 + DF * len(self.omega)
