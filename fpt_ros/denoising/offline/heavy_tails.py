"""Noise of heavy tails: Student's t, and the samples as normal noise would have made them.

Impulses in normal noise (:mod:`mixture`) are one kind of outliers; noise whose tails fall slowly,
as Laplace's, has others, and in it a mean of the samples is not the best that is known of the
signal. With the density g of the noise, f near the signal and I the Fisher information::

    z = f + psi(y - f) / I,    psi = -g' / g,    I = E psi^2 = (nu + 1) / (nu + 3) / scale^2

is the record in noise of variance 1 / I, which is less than that of y: one step of an M-estimator
from f (Bickel, J. American Statistical Association 70, 1975), whatever smoother takes it.
"""

import math
from dataclasses import dataclass

import numpy as np
from scipy.special import gammaln

from fpt_ros.denoising.offline import Mask, Signal, mixture

DEGREES = (2.0, 2.5, 3.0, 4.0, 5.0)
"""Degrees of freedom tried: with more it is nearly normal."""
ROUNDS = 40
CLEAR, NORMAL = 3.0, 6.0
"""By how much its log likelihood is above that of impulses in normal noise, and of normal noise."""
LEAST = 0.1
"""Median residual, in units of sigma, below which nothing is known of the noise: the record
stays."""


@dataclass(frozen=True)
class Tail:
    """Student's t.

    Attributes:
        nu: degrees of freedom.
        scale: unit of y.
    """

    nu: float
    scale: float

    def log_likelihood(self, r: Signal, present: Mask) -> float:
        """Sum over the present samples of the logarithm of the density at ``r``."""
        nu = self.nu
        constant = float(gammaln(0.5 * nu + 0.5) - gammaln(0.5 * nu)) - 0.5 * math.log(nu * math.pi)
        level = constant - math.log(self.scale)
        return float(
            np.sum(level - 0.5 * (nu + 1.0) * np.log1p((r[present] / self.scale) ** 2 / nu))
        )

    def normal(self, y: Signal, f: Signal) -> Signal:
        """The samples ``y`` as normal noise of variance 1 / I would have made them."""
        r = y - f
        weight = (self.nu + 3.0) / (self.nu + (r / self.scale) ** 2)
        return f + weight * r


def find(r: Signal, present: Mask, noise: mixture.Noise) -> Tail | None:
    """The most likely one, where it is clearly more likely than normal noise with impulses.

    Args:
        r: residuals, shape (n,).
        present: False where a sample is missing.
        noise: the mixture that was taken for their noise, of one level.
    """
    square = r[present] ** 2
    if math.sqrt(float(np.median(square))) < LEAST * noise.s:
        return None
    tails = [_scaled(nu, square) for nu in DEGREES]
    tail = max(tails, key=lambda one: one.log_likelihood(r, present))
    normal = -0.5 * len(square) * (math.log(2.0 * math.pi * float(np.mean(square))) + 1.0)
    other = max(noise.log_likelihood(r, present) + CLEAR, normal + NORMAL)
    return tail if tail.log_likelihood(r, present) > other else None


def _scaled(nu: float, square: Signal) -> Tail:
    """The most likely scale, by EM, given the squared residuals."""
    power = float(np.median(square))
    for _ in range(ROUNDS):
        power = float(np.mean((nu + 1.0) / (nu + square / power) * square))
    return Tail(nu, math.sqrt(power))
