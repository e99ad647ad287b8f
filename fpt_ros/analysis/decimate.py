"""Fewer points for a plot, without losing what they show."""

import numpy as np
from numpy.typing import NDArray

from fpt_ros.runs.run import Array

LIMIT = 4000
"""Points of a curve; a figure is never as many pixels wide."""


def keep(*signals: Array, limit: int = LIMIT) -> NDArray[np.intp]:
    """Indices that keep the smallest and the largest number of every stretch of the signals.

    Chatter from cycle to cycle stays as wide as it is; a gap (NaN) stays a gap.

    Args:
        signals: (N,) each, at the same times.
        limit: number of points above which points are dropped.

    Returns:
        (M,) rising; the first and the last point are among them. M <= N, and M is about ``limit``.
    """
    count = len(signals[0])
    if count <= limit:
        return np.arange(count)
    gaps = any(bool(np.isnan(signal).any()) for signal in signals)
    stretches = max(1, limit // (len(signals) * (3 if gaps else 2)))
    width = -(-count // stretches)
    padding = -count % width
    chosen = [np.array([0, count - 1])]
    starts = np.arange(0, count, width)
    for signal in signals:
        known = ~np.isnan(signal)
        for fill, pick in ((np.inf, np.argmin), (-np.inf, np.argmax)):
            padded = np.append(np.where(known, signal, fill), np.full(padding, fill))
            chosen.append(starts + pick(padded.reshape(-1, width), axis=1))
        if gaps:
            padded = np.append(known, np.full(padding, True))
            chosen.append(starts + np.argmin(padded.reshape(-1, width), axis=1))
    return np.unique(np.clip(np.concatenate(chosen), 0, count - 1))


def keep_path(x: Array, y: Array, limit: int = LIMIT) -> NDArray[np.intp]:
    """Indices that keep the shape of the path (x, y), as a phase trajectory is one.

    Half of the points stand at equal distances along the path, so that fast stretches stay round;
    the others are the extremes of both signals.

    Args:
        x, y: (N,).
        limit: number of points above which points are dropped.

    Returns:
        (M,) rising; M <= N, and M is about ``limit``.
    """
    if len(x) <= limit:
        return np.arange(len(x))
    steps = np.zeros(len(x))
    for signal in (x, y):
        known = signal[np.isfinite(signal)]
        width = float(np.ptp(known)) if len(known) else 0.0
        step = np.diff(signal, prepend=signal[:1]) / (width or 1.0)
        steps = np.hypot(steps, np.where(np.isfinite(step), step, 0.0))
    length = np.cumsum(steps)
    even = np.searchsorted(length, np.linspace(0.0, length[-1], limit // 2))
    ends = keep(x, y, limit=limit // 2)
    return np.unique(np.concatenate([even, ends]).clip(0, len(x) - 1))
