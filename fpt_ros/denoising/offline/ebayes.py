"""Wavelet shrinkage by empirical Bayes, on the undecimated transform: a member of ``auto``.

The prior of a coefficient x / sigma is (1 - w) delta_0 + w times the Laplace density of scale 1/2;
w of each level maximises the marginal likelihood, and the estimate is the posterior median
(Johnstone and Silverman, Annals of Statistics 32, 2004; 33, 2005)::

    beta(x) = g(x) / phi(x) - 1,    sum beta / (1 + w beta) = 0

"""

import math

import numpy as np
from scipy.special import erfcx, log_ndtr, ndtri

from fpt_ros.denoising.offline import Sigma, Signal
from fpt_ros.denoising.offline.undecimated import bank

A = 0.5
"""Scale of the Laplace density."""
HALVINGS = 30
STEP = 0.1
FARTHEST = 25.0
"""Beyond this the posterior median is the coefficient less A."""


def _mills(x: Signal) -> Signal:
    """(1 - Phi(x)) / phi(x)."""
    return np.asarray(math.sqrt(0.5 * math.pi) * erfcx(x / math.sqrt(2.0)))


def beta(x: Signal) -> Signal:
    """g(x) / phi(x) - 1 of coefficients in units of sigma."""
    size = np.minimum(np.abs(x), FARTHEST)
    return np.asarray(0.5 * A * (_mills(size + A) + _mills(A - size)) - 1.0)


def share(b: Signal, n: float) -> float:
    """The w of most likelihood, at least that whose threshold is sqrt(2 ln n)."""
    bound = math.sqrt(2.0 * math.log(max(n, 2.0)))
    at = bound - A
    least = A * math.exp(float(log_ndtr(at)) + 0.5 * at * at) * math.sqrt(2.0 * math.pi)
    low = 1.0 / max(least - float(beta(np.array([bound]))[0]), 1.0)
    high = 1.0

    def slope(w: float) -> float:
        return float(np.sum(b / (1.0 + w * b)))

    if slope(low) <= 0.0:
        return low
    if slope(high) >= 0.0:
        return high
    for _ in range(HALVINGS):
        middle = math.sqrt(low * high)
        if slope(middle) > 0.0:
            low = middle
        else:
            high = middle
    return low


def median(x: Signal, w: float, b: Signal) -> Signal:
    """Posterior medians of coefficients in units of sigma."""
    size = np.minimum(np.abs(x), FARTHEST)
    tail = np.exp(-0.5 * (size - A) ** 2) / math.sqrt(2.0 * math.pi) / A * (1.0 / w + b)
    middle = np.maximum(size - A - ndtri(np.minimum(tail, 1.0 - 1e-16)), 0.0)
    middle = np.where(tail >= 1.0, 0.0, middle)
    return np.asarray(np.sign(x) * np.where(np.abs(x) > FARTHEST, np.abs(x) - A, middle))


def _slope(x: Signal, w: float) -> Signal:
    """Derivative of the posterior median, over the width of ``2 STEP``."""
    up, down = x + STEP, x - STEP
    return (median(up, w, beta(up)) - median(down, w, beta(down))) / (2.0 * STEP)


def shrink(y: Signal, sigma: Sigma, wavelet: str = "sym8") -> tuple[Signal, float]:
    """The estimate for white noise of ``sigma``, shape (n,), and its degrees of freedom.

    Where sigma varies a coefficient has that of its place. The degrees of freedom are the trace of
    the derivative for given w.
    """
    n = len(y)
    transform = bank(wavelet, n)
    bands = transform.analyse(y)
    local = np.broadcast_to(sigma, (n,))
    if local.max() <= 0.0:
        return y.copy(), float(n)
    local = np.concatenate((local, local[::-1]))
    df = n / 2.0**transform.levels
    for j in range(transform.levels):
        x = bands[j] / local
        b = beta(x)
        w = share(b, n)
        kept = median(x, w, b)
        df += n / 2.0 ** (j + 1) * float(np.mean(_slope(x, w)))
        bands[j] = kept * local
    return transform.synthesise(bands), min(df, float(n))
