"""The marginal likelihood of a process as a function of its hyperparameters, and its maximum.

A quasi-Newton method (BFGS) within bounds, compiled together with the filter: a step of it costs
little more than the likelihoods it asks for.
"""

import math

import numpy as np
from numba import njit

from fpt_ros.denoising.offline import Signal
from fpt_ros.denoising.offline.kalman import likelihood

LEAST_Q = 0.55
"""Of an oscillator: below 1/2 it does not ring."""
WIDTH = 1e-3
"""Of the differences for the gradient."""
LONGEST = 2.0
"""Step of a logarithm at most."""


@njit(cache=True)
def parts_of(kinds: Signal, x: Signal) -> Signal:
    """Components in units of s from logarithms of amplitude, scale and, of oscillators, quality."""
    parts = np.zeros((len(kinds), 4))
    k = 0
    for row in range(len(kinds)):
        parts[row, 0] = kinds[row]
        parts[row, 1] = math.exp(x[k])
        parts[row, 2] = math.exp(x[k + 1])
        k += 2
        if kinds[row] == 3.0:
            parts[row, 3] = LEAST_Q + math.exp(x[k])
            k += 1
    return parts


@njit(cache=True)
def cost(
    y: Signal, relative: Signal, dt: Signal, kinds: Signal, x: Signal, count: int, least: float
) -> float:
    """-2 ln L but for a constant, s being the best that is at least ``least``."""
    square, logs = likelihood(y, relative, dt, parts_of(kinds, x))
    power = max(square / count, least * least, 1e-300)
    total = count * math.log(power) + logs + square / power
    return total if math.isfinite(total) else 1e12


@njit(cache=True)
def descend(
    y: Signal,
    relative: Signal,
    dt: Signal,
    kinds: Signal,
    start: Signal,
    low: Signal,
    high: Signal,
    count: int,
    least: float,
    steps: int,
    close: float,
) -> tuple[Signal, float]:
    """The hyperparameters of least cost near ``start``, and that cost."""
    n = len(start)
    x = np.minimum(np.maximum(start, low), high)
    value = cost(y, relative, dt, kinds, x, count, least)
    gradient, before, moves = np.zeros(n), np.zeros(n), np.zeros(n)
    inverse = np.eye(n)
    for step in range(steps):
        for k in range(n):
            moved = x.copy()
            width = WIDTH if x[k] + WIDTH <= high[k] else -WIDTH
            moved[k] += width
            gradient[k] = (cost(y, relative, dt, kinds, moved, count, least) - value) / width
            # a bound that is pushed against holds
            if (x[k] <= low[k] and gradient[k] > 0.0) or (x[k] >= high[k] and gradient[k] < 0.0):
                gradient[k] = 0.0
        if step > 0:
            change = gradient - before
            curve = np.sum(change * moves)
            if curve > 1e-10:
                turned = np.zeros(n)
                for i in range(n):
                    for j in range(n):
                        turned[i] += inverse[i, j] * change[j]
                along = np.sum(change * turned)
                for i in range(n):
                    for j in range(n):
                        inverse[i, j] += (1.0 + along / curve) * moves[i] * moves[j] / curve
                        inverse[i, j] -= (turned[i] * moves[j] + moves[i] * turned[j]) / curve
            else:
                inverse = np.eye(n)
        direction = np.zeros(n)
        for i in range(n):
            for j in range(n):
                direction[i] -= inverse[i, j] * gradient[j]
        slope = np.sum(direction * gradient)
        if slope >= 0.0:
            inverse = np.eye(n)
            direction = -gradient
            slope = -np.sum(gradient * gradient)
        if slope > -1e-9:
            break
        longest = np.max(np.abs(direction))
        length = min(1.0, LONGEST / longest)
        if step == 0:
            length = min(length, 1.0 / longest)
        better = value
        moves = np.zeros(n)
        for _ in range(10):
            trial = np.minimum(np.maximum(x + length * direction, low), high)
            better = cost(y, relative, dt, kinds, trial, count, least)
            if better < value + 1e-4 * length * slope:
                moves = trial - x
                break
            length *= 0.3
        if np.max(np.abs(moves)) == 0.0:
            break
        gained = value - better
        x = x + moves
        value = better
        before[:] = gradient
        if gained < close:
            break
    return x, value
