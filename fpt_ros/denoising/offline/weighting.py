"""Weights by distance around the extrema (thesis section 6.2.2).

With distances d_i, the radius d and u_i = d_i / d:

    GMS      w_i = ((d - d_i) / (d d_i))^2 / sum_j ((d - d_j) / (d d_j))^2            (6.14)
    Shepard  w_i = ((1 - u_i) / u_i)^lambda / sum_j ((1 - u_j) / u_j)^lambda          (6.15)
    Dombi    w_i = 1 / (1 + (u_i / (1 - u_i))^lambda sum_{j != i} ((1 - u_j) / u_j)^lambda)  (6.16)

(6.15) is printed for lambda = 2, where it is (6.14). Misprints corrected: the denominator of (6.14)
is d d_i, not a symbol dd_i; the first exponent of (6.16) is lambda, not 2, and its sum leaves out
i. As printed the weights of (6.16) do not sum to 1; corrected they are those of (6.15) for every
lambda: s_i / (s_i + sum of the others), with s = ((1 - u) / u)^lambda.
"""

import numpy as np
from numpy.typing import NDArray

from fpt_ros.denoising.offline import Signal

FLOOR = 0.5
"""Least distance [samples]: that of a sample to itself is 0, where no weight is defined."""


def gms(distances: Signal, radius: float) -> Signal:
    """(6.14): weights of samples at these ``distances``, 0 < d_i < radius, shape (n,)."""
    share = ((radius - distances) / (radius * distances)) ** 2
    return np.asarray(share / np.sum(share))


def shepard(u: Signal, exponent: float = 2.0) -> Signal:
    """(6.15): weights of samples at the relative distances 0 < u < 1, shape (n,)."""
    share = ((1.0 - u) / u) ** exponent
    return np.asarray(share / np.sum(share))


def dombi(u: Signal, exponent: float = 2.0) -> Signal:
    """(6.16): weights of samples at the relative distances 0 < u < 1, shape (n,)."""
    share = ((1.0 - u) / u) ** exponent
    others = np.array([np.sum(np.delete(share, i)) for i in range(len(u))])
    return np.asarray(1.0 / (1.0 + others / share))


def average_around(
    y: Signal, extrema: NDArray[np.int64], radius: int, exponent: float = 2.0
) -> Signal:
    """Samples within ``radius`` of an extremum become weighted means of those within ``radius``.

    Distances are at least ``FLOOR``, and d = radius + 1, so that the farthest sample counts.
    """
    out = y.copy()
    offsets = np.arange(-radius, radius + 1)
    u = np.maximum(np.abs(offsets), FLOOR) / (radius + 1.0)
    for i in np.unique(np.clip(extrema[:, None] + offsets, 0, len(y) - 1)):
        inside = (i + offsets >= 0) & (i + offsets < len(y))
        out[i] = np.sum(dombi(u[inside], exponent) * y[i + offsets[inside]])
    return out
