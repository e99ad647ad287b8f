"""Robust local polynomial regression (loess with bisquare weights) of equispaced samples.

At index i the q nearest samples count (at the ends the window is shifted inward). With
u = (k - i) / (h + 0.5), h the largest distance in the window, tricube weights K = (1 - |u|^3)^3 and
a polynomial in u of degree 1 or 2, the estimate is its value at u = 0. Robust passes::

    s = median |r|,    delta = (1 - (r / 6s)^2)^2 for |r| < 6s, else 0

and the fit is repeated with K delta. The + 0.5 keeps the window's end points in use; without it
the result is that of scikit-misc's loess (``surface="direct"``), which offers no such choice, and
statsmodels' lowess is linear only: hence a loess of our own.

What the thesis leaves out (line 1354): the constant 6 and the test of convergence. Its step 6
"repeat step 1" would transform the signal again; what is repeated is the fit.
"""

import numpy as np
from numba import njit

from fpt_ros.denoising.offline import Signal

BISQUARE = 6.0
PASSES = 10
CLOSE = 1e-3
"""Passes end when no value changes by more than this share of the samples' standard deviation."""


@njit(cache=True)
def _local(y: Signal, delta: Signal, q: int, degree: int, value: Signal, gain: Signal) -> None:
    """One fit at every index; ``gain``: squared norm of the weights, var(value) / var(noise)."""
    n = len(y)
    for i in range(n):
        first = min(max(i - q // 2, 0), n - q)
        h = max(i - first, first + q - 1 - i)
        m = np.zeros(5)  # moments of u
        c = np.zeros(3)  # moments of u with y
        v = np.zeros(5)  # moments of u with squared weights
        for k in range(first, first + q):
            u = (k - i) / (h + 0.5)
            tricube = (1.0 - abs(u) ** 3) ** 3
            w = tricube * delta[k]
            p = w
            for a in range(5):
                m[a] += p
                v[a] += p * w
                if a < 3:
                    c[a] += p * y[k]
                p *= u
        # weights of the samples are w (b0 + b1 u + b2 u^2), b the first row of the inverse
        b0, b1, b2 = 1.0, 0.0, 0.0
        total = m[0]
        two = m[0] * m[2] - m[1] * m[1]
        determinant = (
            m[0] * (m[2] * m[4] - m[3] * m[3])
            - m[1] * (m[1] * m[4] - m[3] * m[2])
            + m[2] * (m[1] * m[3] - m[2] * m[2])
        )
        if degree == 2 and determinant > 1e-10 * total**3:
            b0 = (m[2] * m[4] - m[3] * m[3]) / determinant
            b1 = (m[2] * m[3] - m[1] * m[4]) / determinant
            b2 = (m[1] * m[3] - m[2] * m[2]) / determinant
        elif two > 1e-10 * total**2:
            b0, b1 = m[2] / two, -m[1] / two
        elif total > 0.0:
            b0 = 1.0 / total
        else:  # everything near was rejected
            value[i], gain[i] = np.median(y[first : first + q]), 1.0
            continue
        value[i] = b0 * c[0] + b1 * c[1] + b2 * c[2]
        gain[i] = (
            b0 * b0 * v[0]
            + 2.0 * b0 * b1 * v[1]
            + (b1 * b1 + 2.0 * b0 * b2) * v[2]
            + 2.0 * b1 * b2 * v[3]
            + b2 * b2 * v[4]
        )


def loess(y: Signal, q: int, degree: int = 2, passes: int = PASSES) -> tuple[Signal, Signal]:
    """The robust fit, shape (n,), and the squared norm of its weights at every index.

    Args:
        y: equispaced samples, shape (n,), finite.
        q: samples in the window; at most n are used.
        degree: of the local polynomial, 0 to 2.
        passes: robust passes at most; 0 is plain loess.
    """
    n = len(y)
    y = np.ascontiguousarray(y)
    q = min(q, n)
    value, gain, delta = np.empty(n), np.empty(n), np.ones(n)
    _local(y, delta, q, degree, value, gain)
    scale = CLOSE * float(np.std(y))
    for _ in range(passes):
        r = y - value
        s = float(np.median(np.abs(r)))
        if s <= 1e-12 * float(np.ptp(y)):
            break
        delta = np.where(np.abs(r) < BISQUARE * s, (1.0 - (r / (BISQUARE * s)) ** 2) ** 2, 0.0)
        before = value.copy()
        _local(y, delta, q, degree, value, gain)
        if np.max(np.abs(value - before)) < scale:
            break
    return value, gain
