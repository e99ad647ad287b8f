"""HeurSure (thesis (5.3)): the universal threshold where the risk estimate cannot be trusted.

With k coefficients x in units of sigma::

    eta = (sum x^2 - k) / k,    crit = (log2 k)^(3/2) / sqrt(k)
    nu3 = nu1 if eta < crit else min(nu1, nu2)

Misprint corrected: the print lacks / sqrt(k). Without it the test is practically always true, and
HeurSure is the universal threshold.
"""

import math

import numpy as np

from fpt_ros.denoising.offline import Signal, sureshrink, universal
from fpt_ros.denoising.offline.thresholding import method


def sparse(x: Signal) -> bool:
    """Whether ``x`` (units of sigma) holds too little energy above the noise for (5.2)."""
    k = len(x)
    eta = (float(np.sum(x**2)) - k) / k
    return eta < math.pow(math.log2(k), 1.5) / math.sqrt(k)


def rule(x: Signal, n: int) -> float:
    """(5.3) of the coefficients ``x`` in units of sigma, of a signal of n samples."""
    nu1 = universal.threshold(len(x))
    return nu1 if sparse(x) else min(nu1, sureshrink.threshold(x))


HEURSURE = method(rule, level=4)
