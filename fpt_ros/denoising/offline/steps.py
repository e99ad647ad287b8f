"""Posterior mean of a piecewise constant signal in noise with impulses: a core of ``auto``.

A hidden Markov chain on a grid of levels: from one sample to the next the level stays with the
probability 1 - q, else it is drawn anew. The noise is the mixture of :mod:`mixture`, so impulses
need no removal before. Where Potts (:mod:`potts`) names one place for each jump, the mean over the
posterior hedges among the likely ones. Forward and backward passes take O(n) per level of the grid,
since all jumps are equally likely.
"""

import math

import numpy as np
from numba import njit

from fpt_ros.denoising.offline import Mask, Signal
from fpt_ros.denoising.offline.mixture import Noise

LEVELS = 256
SPARSE = 0.1
"""q is this share of the jumps of the Potts estimate per sample: fewer jumps err less."""


@njit(cache=True, fastmath=True)
def _posterior(
    y: Signal,
    present: Mask,
    levels: Signal,
    q: float,
    p: float,
    sigma: Signal,
    t: float,
    size: float,
    mean: Signal,
    leverage: Signal,
) -> None:
    """Posterior mean and d mean_i / d y_i, written to ``mean`` and ``leverage``."""
    n, m = len(y), len(levels)
    density = np.ones((n, m))
    forward = np.empty((n, m))
    for i in range(n):
        s = sigma[i]
        narrow, wide = s * s, s * s + t * t
        inlier, outlier = (1.0 - p) / s, 0.5 * p / math.sqrt(wide)
        total = 0.0
        for k in range(m):
            if present[i]:
                x = y[i] - levels[k]
                density[i, k] = (
                    inlier * math.exp(-0.5 * x**2 / narrow)
                    + outlier * math.exp(-0.5 * (x - size) ** 2 / wide)
                    + outlier * math.exp(-0.5 * (x + size) ** 2 / wide)
                    + 1e-300
                )
            before = (1.0 - q) * forward[i - 1, k] + q / m if i > 0 else 1.0 / m
            forward[i, k] = density[i, k] * before
            total += forward[i, k]
        for k in range(m):
            forward[i, k] /= total
    backward = np.ones(m)
    for i in range(n - 1, -1, -1):
        total, first = 0.0, 0.0
        for k in range(m):
            forward[i, k] *= backward[k]
            total += forward[i, k]
            first += forward[i, k] * levels[k]
        mean[i] = first / total
        leverage[i] = 0.0
        if present[i]:
            narrow, inlier = sigma[i] * sigma[i], (1.0 - p) / sigma[i]
            for k in range(m):
                weight = inlier * math.exp(-0.5 * (y[i] - levels[k]) ** 2 / narrow) / density[i, k]
                share = forward[i, k] / total
                leverage[i] += share * weight * (levels[k] - mean[i]) ** 2 / narrow
        anywhere = 0.0
        for k in range(m):
            backward[k] *= density[i, k]
            anywhere += backward[k]
        for k in range(m):
            backward[k] = ((1.0 - q) * backward[k] + q * anywhere / m) / anywhere


def smooth(y: Signal, present: Mask, noise: Noise, jumps: int) -> tuple[Signal, float]:
    """The posterior mean, shape (n,), and its degrees of freedom.

    Args:
        y: samples, shape (n,), with their impulses.
        present: False where a sample is missing.
        noise: the mixture of an estimate of this kind.
        jumps: of that estimate.
    """
    low, high = np.quantile(y[present], (0.005, 0.995))
    levels = np.linspace(low - noise.s, high + noise.s, LEVELS)
    mean, leverage = np.empty(len(y)), np.empty(len(y))
    sigma = noise.s * np.broadcast_to(noise.profile, len(y))
    q = SPARSE * max(jumps, 2) / len(y)
    _posterior(y, present, levels, q, noise.p, sigma, noise.t, noise.m, mean, leverage)
    return mean, float(leverage.sum()) + 1.0
