"""Piecewise constant signals (Potts, l0 of the jumps): a core of ``auto``.

::

    min over partitions:  sum over segments of sum (z - mean)^2  +  2.5 sigma^2 ln(n) per segment

solved exactly by PELT (Killick, Fearnhead, Eckley 2012). Its start is a robust one: Viterbi on 300
levels with the loss min(r^2, 9 sigma^2), which single impulses cannot pull.
"""

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from fpt_ros.denoising.offline import Sigma, Signal, scale_and_weight

PENALTY = 2.5
LEVELS = 300
DF = 4.5
"""Degrees of freedom of a segment: its level, and 3.5 for the search of its end: fewer, and smooth
signals pass for stairs."""


@njit(cache=True)
def _pelt(z: Signal, weight: Signal, penalty: float) -> NDArray[np.int64]:
    """First indices of the segments of the optimal partition, ascending, beginning with 0."""
    n = len(z)
    sums = np.zeros(n + 1)
    squares = np.zeros(n + 1)
    weights = np.zeros(n + 1)
    for i in range(n):
        sums[i + 1] = sums[i] + weight[i] * z[i]
        squares[i + 1] = squares[i] + weight[i] * z[i] * z[i]
        weights[i + 1] = weights[i] + weight[i]
    best = np.empty(n + 1)
    best[0] = -penalty
    last = np.zeros(n + 1, dtype=np.int64)
    starts = np.empty(n + 1, dtype=np.int64)
    values = np.empty(n + 1)
    count = 1
    starts[0] = 0
    for end in range(1, n + 1):
        least, where = np.inf, 0
        for k in range(count):
            start = starts[k]
            total = sums[end] - sums[start]
            cost = squares[end] - squares[start] - total * total / (weights[end] - weights[start])
            values[k] = best[start] + cost
            if values[k] < least:
                least, where = values[k], start
        best[end] = least + penalty
        last[end] = where
        kept = 0
        for k in range(count):
            if values[k] <= best[end]:
                starts[kept] = starts[k]
                kept += 1
        starts[kept] = end
        count = kept + 1
    found = np.empty(n + 1, dtype=np.int64)
    m = 0
    end = n
    while end > 0:
        end = last[end]
        found[m] = end
        m += 1
    return found[:m][::-1].copy()


@njit(cache=True)
def _viterbi(y: Signal, levels: Signal, penalty: float, cap: float) -> Signal:
    """The path on ``levels`` of least sum of min(r^2, cap) plus ``penalty`` per jump."""
    n, m = len(y), len(levels)
    cost = np.zeros(m)
    came = np.empty((n, m), dtype=np.int32)
    for i in range(n):
        cheapest = 0
        for k in range(m):
            if cost[k] < cost[cheapest]:
                cheapest = k
        bound = cost[cheapest] + penalty
        for k in range(m):
            came[i, k] = k
            if cost[k] > bound:
                cost[k] = bound
                came[i, k] = cheapest
            r = y[i] - levels[k]
            cost[k] += min(r * r, cap)
    k = int(np.argmin(cost))
    path = np.empty(n)
    for i in range(n - 1, -1, -1):
        path[i] = levels[k]
        k = came[i, k]
    return path


def partition(z: Signal, penalty: float, weight: Signal | None = None) -> NDArray[np.int64]:
    """First indices of the segments that minimise the squared error + ``penalty`` [unit of z^2].

    Errors are weighted by ``weight``, shape (n,), if it is given.
    """
    weight = np.ones(len(z)) if weight is None else weight
    found: NDArray[np.int64] = _pelt(np.ascontiguousarray(z), weight, penalty)
    return found


def smooth(z: Signal, sigma: Sigma) -> tuple[Signal, float]:
    """The piecewise constant estimate, shape (n,), and its degrees of freedom."""
    n = len(z)
    typical, weight = scale_and_weight(sigma, n)
    starts = partition(z - np.median(z), PENALTY * typical**2 * math.log(n), weight)
    lengths = np.diff(np.append(starts, n))
    means = np.add.reduceat(weight * z, starts) / np.add.reduceat(weight, starts)
    return np.repeat(means, lengths), DF * len(starts)


def robust_start(y: Signal, sigma: float) -> Signal:
    """A piecewise constant path through ``y`` that impulses do not pull, shape (n,)."""
    low, high = np.quantile(y, (0.005, 0.995))
    levels = np.linspace(low, high, LEVELS)
    penalty = PENALTY * sigma**2 * math.log(len(y))
    path: Signal = _viterbi(np.ascontiguousarray(y), levels, penalty, 9.0 * sigma**2)
    return path
