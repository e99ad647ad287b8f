"""Kalman filter and smoother of sums of small stationary processes: Gaussian processes in O(n).

The processes are :mod:`components`; steps of time need not be equal.
"""

import math

import numpy as np
from numba import njit

from fpt_ros.denoising.offline import Signal
from fpt_ros.denoising.offline.components import size, stationary, transition

UNKNOWN = 1e30
"""Variance of a sample that is missing."""
STEADY = 1e-9
"""Relative change of the covariance below which the filter is taken as steady."""


@njit(cache=True, fastmath=True)
def _predict(A: Signal, rest: Signal, P: Signal, work: Signal) -> None:
    """P = rest + A (P - rest) A', in place."""
    d = len(A)
    for i in range(d):
        for j in range(d):
            total = 0.0
            for m in range(d):
                total += A[i, m] * (P[m, j] - rest[m, j])
            work[i, j] = total
    for i in range(d):
        for j in range(i, d):
            total = rest[i, j]
            for m in range(d):
                total += work[i, m] * A[j, m]
            P[i, j] = total
            P[j, i] = total


@njit(cache=True, fastmath=True)
def _gain(P: Signal, first: Signal, variance: float, gain: Signal) -> tuple[float, float]:
    """The innovation's variance S and ln S; ``gain`` gets P first, S times the gain."""
    S = variance
    for a in range(len(first)):
        gain[a] = 0.0
        for b in range(len(first)):
            gain[a] += P[a, b] * first[b]
    for a in range(len(first)):
        S += first[a] * gain[a]
    return S, math.log(S)


@njit(cache=True, fastmath=True)
def likelihood(y: Signal, variance: Signal, dt: Signal, parts: Signal) -> tuple[float, float]:
    """Sum of e^2 / S and of ln S over the samples that are not missing, e the innovations.

    Args:
        y: samples, shape (n,), of mean 0.
        variance: of the noise at each sample, shape (n,).
        dt: step before each sample; the first is not used.
        parts: components, shape (k, 4).
    """
    n, d = len(y), size(parts)
    rest, first = np.empty((d, d)), np.empty(d)
    stationary(parts, rest, first)
    A, P, work = np.empty((d, d)), rest.copy(), np.empty((d, d))
    before = np.zeros((d, d))  # the predicted covariance of the last step
    m, moved, gain = np.zeros(d), np.empty(d), np.empty(d)
    square, logs, last = 0.0, 0.0, -1.0
    S, log, steady = 1.0, 0.0, False
    for i in range(n):
        if i > 0:
            same = dt[i] == last
            if not same:
                transition(parts, dt[i], A)
                last = dt[i]
            for a in range(d):
                total = 0.0
                for b in range(d):
                    total += A[a, b] * m[b]
                moved[a] = total
            m, moved = moved, m
            same = same and variance[i] == variance[i - 1]
            if steady and not same:
                # P is the predicted covariance: what the step after it begins from is the updated
                for a in range(d):
                    for b in range(d):
                        P[a, b] -= gain[a] * gain[b] / S
                steady = False
            if not steady:
                _predict(A, rest, P, work)
                change = 0.0
                for a in range(d):
                    change = max(change, abs(P[a, a] - before[a, a]) - STEADY * P[a, a])
                    before[a, a] = P[a, a]
                steady = same and change <= 0.0 and variance[i] < UNKNOWN
                if steady:
                    S, log = _gain(P, first, variance[i], gain)
        if variance[i] >= UNKNOWN:
            continue
        if not steady:
            S, log = _gain(P, first, variance[i], gain)
        e = y[i]
        for a in range(d):
            e -= first[a] * m[a]
        square += e * e / S
        logs += log
        for a in range(d):
            m[a] += gain[a] * e / S
        if not steady:
            for a in range(d):
                for b in range(d):
                    P[a, b] -= gain[a] * gain[b] / S
    return square, logs


@njit(cache=True, fastmath=True)
def smooth(
    y: Signal, variance: Signal, dt: Signal, parts: Signal, signal: Signal
) -> tuple[Signal, Signal, Signal]:
    """Posterior means of all states, variance of the signal in them, and its leverage.

    Backwards by the recursion of de Jong (Biometrika 76, 1989), which inverts nothing.

    Args:
        y, variance, dt, parts: as of :func:`likelihood`.
        signal: 1 at the components that are the signal, 0 at those that are noise, shape (k,).

    Returns:
        Means, shape (n, d); variance of the signal, shape (n,); the derivative of each estimate by
        its own sample, shape (n,), 0 where it is missing.
    """
    n, d = len(y), size(parts)
    rest, first = np.empty((d, d)), np.empty(d)
    stationary(parts, rest, first)
    own, c = np.zeros(d), -1  # the states that are the signal
    for a in range(d):
        if first[a] > 0.0:
            c += 1
            own[a] = signal[c]
    A, work = np.empty((d, d)), np.empty((d, d))
    mean, cov, gains = np.zeros((n, d)), np.empty((n, d, d)), np.zeros((n, d))
    error, scale = np.zeros(n), np.zeros(n)
    P, m, moved = rest.copy(), np.zeros(d), np.empty(d)
    last = -1.0
    for i in range(n):
        if i > 0:
            if dt[i] != last:
                transition(parts, dt[i], A)
                last = dt[i]
            for a in range(d):
                moved[a] = 0.0
                for b in range(d):
                    moved[a] += A[a, b] * m[b]
            m, moved = moved, m
            _predict(A, rest, P, work)
        for a in range(d):
            mean[i, a] = m[a]
            for b in range(d):
                cov[i, a, b] = P[a, b]
        if variance[i] >= UNKNOWN:
            continue
        S, e = variance[i], y[i]
        for a in range(d):
            for b in range(d):
                gains[i, a] += P[a, b] * first[b]
            e -= first[a] * m[a]
        for a in range(d):
            S += first[a] * gains[i, a]
        error[i], scale[i] = e, S
        for a in range(d):
            m[a] += gains[i, a] * e / S
            for b in range(d):
                P[a, b] -= gains[i, a] * gains[i, b] / S
    r, N, kept = np.zeros(d), np.zeros((d, d)), np.empty(d)
    spread, leverage = np.empty(n), np.zeros(n)
    left, right = np.empty(d), np.empty(d)
    for i in range(n - 1, -1, -1):
        if scale[i] > 0.0:
            S = scale[i]
            # r = first e / S + (1 - gain first' / S)' r, and N alike
            along = 0.0
            for a in range(d):
                along += gains[i, a] * r[a]
            for a in range(d):
                r[a] += first[a] * (error[i] - along) / S
            twice = 0.0
            for a in range(d):
                kept[a] = 0.0
                for b in range(d):
                    kept[a] += N[a, b] * gains[i, b]
                twice += gains[i, a] * kept[a]
            for a in range(d):
                for b in range(d):
                    N[a, b] += first[a] * first[b] * (1.0 + twice / S) / S
                    N[a, b] -= (first[a] * kept[b] + kept[a] * first[b]) / S
        for a in range(d):
            for b in range(d):
                mean[i, a] += cov[i, a, b] * r[b]
        own_var, shared = 0.0, 0.0
        for a in range(d):
            left[a] = 0.0
            right[a] = 0.0
            for b in range(d):
                left[a] += cov[i, a, b] * own[b]
                right[a] += cov[i, a, b] * first[b]
        for a in range(d):
            own_var += own[a] * left[a]
            shared += first[a] * left[a]
            for b in range(d):
                own_var -= left[a] * N[a, b] * left[b]
                shared -= right[a] * N[a, b] * left[b]
        spread[i] = max(own_var, 0.0)
        if scale[i] > 0.0:
            leverage[i] = shared / variance[i]
        if i > 0:
            if dt[i] != last:
                transition(parts, dt[i], A)
                last = dt[i]
            for a in range(d):
                moved[a] = 0.0
                for b in range(d):
                    moved[a] += A[b, a] * r[b]
            for a in range(d):
                r[a] = moved[a]
            for a in range(d):
                for b in range(d):
                    work[a, b] = 0.0
                    for k in range(d):
                        work[a, b] += N[a, k] * A[k, b]
            for a in range(d):
                for b in range(d):
                    N[a, b] = 0.0
                    for k in range(d):
                        N[a, b] += A[k, a] * work[k, b]
    return mean, spread, leverage
