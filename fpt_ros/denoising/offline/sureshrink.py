"""SureShrink (thesis (5.2)): the threshold of least unbiased estimate of the risk (Stein).

With the squares s_1 <= .. <= s_n of the coefficients, in units of sigma^2::

    risk_i = [n - 2 i + sum_{j<=i} s_j + (n - i) s_i] / n,    nu2 = sigma sqrt(s_i*),  i* = argmin

Misprints corrected: the absolute value around the risk; the sum's upper limit k instead of i;
omega_i^2 although Omega holds squares already; "omega is the smallest element of the RISK vector":
it is the coefficient AT the smallest risk; sigma is the noise's standard deviation, not that of the
noisy signal. Literally: 0.3 instead of 8.3 dB on sines.
"""

import numpy as np

from fpt_ros.denoising.offline import Signal
from fpt_ros.denoising.offline.thresholding import method


def risks(x: Signal) -> tuple[Signal, Signal]:
    """Squares of ``x`` (units of sigma) in ascending order, and the risk per sample at each."""
    n = len(x)
    squares = np.sort(x**2)
    i = np.arange(1, n + 1)
    return squares, (n - 2 * i + np.cumsum(squares) + (n - i) * squares) / n


def threshold(x: Signal) -> float:
    """(5.2) in units of sigma; 0 where there is no coefficient."""
    if not len(x):
        return 0.0
    squares, risk = risks(x)
    return float(np.sqrt(squares[np.argmin(risk)]))


def rule(x: Signal, n: int) -> float:
    """(5.2) of the coefficients ``x`` in units of sigma."""
    return threshold(x)


SURESHRINK = method(rule, level=8)
