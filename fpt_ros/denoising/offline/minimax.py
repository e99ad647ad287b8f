"""Minimax threshold (thesis (5.4)): nu4 = sigma (0.3936 + 0.1829 log2 n) for n > 32, else 0.

It keeps the largest possible mean squared error smallest.

Misprint corrected: the print has 0.1829 s instead of the logarithm of s (187 sigma at 1024
samples), and nu_MAD for sigma_MAD. Literally: 8.8 instead of 10.8 dB on sines.
"""

import math

from fpt_ros.denoising.offline import Signal
from fpt_ros.denoising.offline.thresholding import method

FEWEST = 32
"""Up to this many samples nothing is removed."""


def threshold(n: int) -> float:
    """(5.4) in units of sigma."""
    return 0.3936 + 0.1829 * math.log2(n) if n > FEWEST else 0.0


def rule(x: Signal, n: int) -> float:
    """(5.4), the same for all coefficients ``x`` of a signal of n samples."""
    return threshold(n)


MINIMAX = method(rule, level=4)
