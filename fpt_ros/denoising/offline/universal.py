"""Universal threshold (thesis (5.1)): nu1 = sigma sqrt(2 ln n).

The largest of n samples of white noise stays below it almost surely as n grows.

Misprint corrected: the print has sqrt(2) log s_j, the logarithm outside the root: 9.8 sigma instead
of 3.72 sigma at 1000 samples (4.3 instead of 13.6 dB on sines). n is the length of the signal, as
in MATLAB; the print takes that of the level.
"""

import math

from fpt_ros.denoising.offline import Signal
from fpt_ros.denoising.offline.thresholding import method


def threshold(n: int) -> float:
    """(5.1) in units of sigma, for n >= 1 samples."""
    return math.sqrt(2.0 * math.log(n))


def rule(x: Signal, n: int) -> float:
    """(5.1), the same for all coefficients ``x`` of a signal of n samples."""
    return threshold(n)


UNIVERSAL = method(rule, level=4)
