"""Least squares for the phases of several sweeps together, and ways out of local optima."""

import math
from typing import Any

import numpy as np
from numba import njit

from fpt_ros.denoising.offline import Signal
from fpt_ros.denoising.offline.sweep_phase import frequency, phase, second, third

LONGEST, LEAST_SHARE = 2.0, 0.05
"""Longest change [rad] of a step, and the least share of it that is tried."""
SETTLED = 1e-5
"""Relative gain of a step, below which it was the last."""
STEPS, FEW, FIRST = 30, 6, 4
"""Steps: of the fit that counts, where it begins near its end, and for a first impression."""
AWAY = 2.5
"""From a local optimum to the next [rad]."""
NEAR = 2.0
"""Sweeps meet where their frequencies are as near as that, times sqrt(n) [rad per half record]."""
BETTER, WORTH = 0.98, 1.1
"""Of the sum of squares: what is taken, and what is worth more steps."""


@njit(cache=True)
def _waves(root: Signal, phases: Signal) -> Signal:
    """Rows: 1, and of each sweep cos and sin; all times ``root``."""
    n, k = len(root), len(phases)
    middle = 0.5 * (n - 1)
    rows = np.empty((1 + 2 * k, n))
    rows[0] = root
    for j in range(k):
        for i in range(n):
            phi = phase(phases[j], (i - middle) / middle)
            rows[1 + 2 * j, i] = root[i] * math.cos(phi)
            rows[2 + 2 * j, i] = root[i] * math.sin(phi)
    return rows


@njit(cache=True)
def _with_slopes(rows: Signal, amplitude: Signal) -> Signal:
    """The same, and behind it of each sweep the derivatives by the three numbers of its phase."""
    size, n = rows.shape
    middle = 0.5 * (n - 1)
    more = np.empty((size + 3 * (size // 2), n))
    more[:size] = rows
    for j in range(size // 2):
        a, b = amplitude[2 * j], amplitude[2 * j + 1]
        at = size + 3 * j
        for i in range(n):
            s = (i - middle) / middle
            slope = b * rows[1 + 2 * j, i] - a * rows[2 + 2 * j, i]
            more[at, i] = slope * s
            more[at + 1, i] = slope * second(s)
            more[at + 2, i] = slope * third(s)
    return more


@njit(cache=True)
def _solve(rows: Signal, target: Signal) -> Any:
    gram = rows @ rows.T
    for i in range(len(gram)):
        gram[i, i] += 1e-9 * len(target)
    return np.linalg.solve(gram, rows @ target)


@njit(cache=True)
def fit(z: Signal, root: Signal, phases: Signal, steps: int) -> Signal:
    """Gauss-Newton, halved where it overshoots, on ``phases``, shape (k, 3), in place.

    Residuals count ``root`` times, shape (n,). Returns the sum of the sweeps and a constant.
    """
    k = len(phases)
    target = root * z
    best, share = math.inf, 1.0
    kept, change = phases.copy(), np.zeros((k, 3))
    f = np.zeros(len(z))
    for _ in range(steps):
        rows = _waves(root, phases)
        solution = _solve(rows, target)
        fitted = solution @ rows
        rss = float(np.sum((target - fitted) ** 2))
        if rss < best:
            settled = best - rss < SETTLED * rss
            best, share = rss, min(1.0, 2.0 * share)
            kept[:] = phases
            f = fitted / root
            if settled:
                break
            solution = _solve(_with_slopes(rows, solution[1:]), target)
            for j in range(k):
                for c in range(3):
                    wanted = solution[1 + 2 * k + 3 * j + c]
                    change[j, c] = min(max(wanted, -LONGEST), LONGEST)
        else:
            share *= 0.5
            if share < LEAST_SHARE:
                break
        phases[:] = kept + share * change
    phases[:] = kept
    return f


@njit(cache=True)
def rss_of(z: Signal, root: Signal, f: Signal) -> float:
    """The sum of squares that is minimised."""
    return float(np.sum((root * (z - f)) ** 2))


@njit(cache=True)
def move(z: Signal, root: Signal, phases: Signal, f: Signal) -> Signal:
    """Out of a local optimum, in place: the newest sweep is moved, and all are fitted again."""
    best = rss_of(z, root, f)
    start = phases.copy()
    for a in range(-1, 2):
        for b in range(-1, 2):
            for c in range(-1, 2):
                trial = start.copy()
                trial[-1] += AWAY * np.array([a, b, c], dtype=np.float64)
                f = fit(z, root, trial, FEW)
                rss = rss_of(z, root, f)
                if rss < BETTER * best:
                    best = rss
                    phases[:] = trial
    return fit(z, root, phases, STEPS)


@njit(cache=True)
def slip(z: Signal, root: Signal, phases: Signal, f: Signal) -> Signal:
    """Out of local optima where two sweeps meet at an end: there both slip a turn, in place."""
    best = rss_of(z, root, f)
    near = NEAR * math.sqrt(len(z))
    for i in range(len(phases)):
        for j in range(i):
            for end in (-1.0, 1.0):
                if abs(frequency(phases[i], end) - frequency(phases[j], end)) > near:
                    continue
                start = phases.copy()
                turn = AWAY * np.array([end, 1.0, end])
                for a in range(-1, 2):
                    for b in range(-1, 2):
                        trial = start.copy()
                        trial[i] += a * turn
                        trial[j] += b * turn
                        f = fit(z, root, trial, FIRST)
                        rss = rss_of(z, root, f)
                        if BETTER * best <= rss < WORTH * best:
                            f = fit(z, root, trial, 2 * FEW)
                            rss = rss_of(z, root, f)
                        if rss < BETTER * best:
                            best = rss
                            phases[:] = trial
    return fit(z, root, phases, STEPS)
