"""The phase of a sweep, and how the strongest one of a signal is found.

A sweep is A cos(phi(s)) + B sin(phi(s)), s from -1 to 1 along the record, with the phase::

    phi(s) = p1 P1(s) + p2 P2(s) + p3 P3(s)

in Legendre polynomials: they are orthogonal, so that each number can be found by itself. Its
frequency runs along a parabola, and above half the sampling rate it is folded, as sampling does.

First the parabola with the most logarithmic power in the spectrogram is found (a Hough transform);
then the phase is made coherent over pieces that double in length, up to the whole record.
"""

import math
from typing import Any

import numpy as np
from numba import njit

from fpt_ros.denoising.offline import Signal

FRAMES = 64
"""Frames of the spectrogram at most."""
STEP = 0.8
"""Of the search, per piece [rad]."""
ROUNDS = 20


@njit(cache=True)
def second(s: float) -> float:
    """P2(s)."""
    return 1.5 * s * s - 0.5


@njit(cache=True)
def third(s: float) -> float:
    """P3(s)."""
    return (2.5 * s * s - 1.5) * s


@njit(cache=True)
def phase(p: Signal, s: float) -> Any:
    """phi(s) [rad]."""
    return p[0] * s + p[1] * second(s) + p[2] * third(s)


@njit(cache=True)
def frequency(p: Signal, s: float) -> Any:
    """D phi / ds [rad per half record]."""
    return p[0] + 3.0 * p[1] * s + p[2] * (7.5 * s * s - 1.5)


def turns(p: Signal) -> float:
    """How many turns a sweep makes in the record, there and back."""
    return float(np.mean([abs(frequency(p, s)) for s in np.linspace(-1.0, 1.0, 65)]) / math.pi)


@njit(cache=True)
def _parabola(power: Signal, places: Signal, cells: int) -> Signal:
    """Frequencies at start, middle and end [cells] of the parabola with the most power.

    ``power``: (frames, cells + 1), of frequencies from 0 to half the sampling rate; ``places``: s
    of each frame.
    """
    best = -1.0
    found = np.zeros(3)
    frames, period = len(places), 2 * cells
    folded = np.empty((frames, 3 * period))  # for cells -period and on: no parabola leaves it
    for k in range(frames):
        for i in range(3 * period):
            cell = i % period
            folded[k, i] = power[k, cell if cell <= cells else period - cell]
    rest = np.zeros(frames)  # what may still come after each frame
    for k in range(frames - 1, 0, -1):
        rest[k - 1] = rest[k] + power[k].max()
    least = -rest  # with less a parabola cannot have the most power any more
    for at in range(1, cells):
        for first in range(at - cells, at + cells + 1):
            for last in range(at - cells, at + cells + 1):
                slope, bend = 0.5 * (last - first), 0.5 * (first + last - 2 * at)
                total = 0.0
                for k in range(frames):
                    s = places[k]
                    total += folded[k, int(np.rint(at + s * (slope + s * bend))) + period]
                    if total < least[k]:
                        break
                if total > best:
                    best = total
                    found[0], found[1], found[2] = first, at, last
                    least[:] = (1.0 - 1e-9) * best - rest
    return found


@njit(cache=True)
def _coherent(z: Signal, p: Signal, pieces: int) -> float:
    """Sum over the pieces of |sum of z exp(-i phi)|^2."""
    n = len(z)
    middle = 0.5 * (n - 1)
    total = 0.0
    for piece in range(pieces):
        x = y = 0.0
        for i in range(piece * n // pieces, (piece + 1) * n // pieces):
            phi = phase(p, (i - middle) / middle)
            x += z[i] * math.cos(phi)
            y += z[i] * math.sin(phi)
        total += x * x + y * y
    return total


@njit(cache=True)
def _refine(z: Signal, p: Signal, pieces: int) -> None:
    """Make a phase coherent over the whole record, in place, from what it is over the pieces."""
    near = p.copy()
    while True:
        step = STEP * pieces
        best = _coherent(z, p, pieces)
        for _ in range(ROUNDS):
            base = p.copy()
            for a in range(-1, 2):
                for b in range(-1, 2):
                    for c in range(-1, 2):
                        near[0], near[1] = base[0] + a * step, base[1] + b * step
                        near[2] = base[2] + c * step
                        value = _coherent(z, near, pieces)
                        if value > best:
                            best = value
                            p[:] = near
            if (p == base).all():
                break
        if pieces == 1:
            return
        pieces = max(1, pieces // 2)


def strongest(z: Signal, slow: int = 0) -> Signal:
    """The phase (p1, p2, p3) of the strongest sweep of a signal, shape (n,).

    ``slow``: cells of the spectrogram, from 0 on, that hold a curve and count nothing.
    """
    n = len(z)
    window = int(2 ** round(math.log2(math.sqrt(2.0 * n))))  # for a sweep over the whole band
    hop = max(window // 2, -(-(n - window) // (FRAMES - 1)))
    starts = np.arange(0, n - window + 1, hop)
    frames = z[starts[:, None] + np.arange(window)] * np.hanning(window + 2)[1:-1]
    power = np.abs(np.fft.rfft(frames, 2 * window, axis=1)) ** 2
    seen: Signal = np.log1p(power / max(float(np.median(power)), 1e-300))
    seen[:, :slow] = 0.0
    middle = 0.5 * (n - 1)
    places = np.asarray((starts + 0.5 * (window - 1) - middle) / middle, dtype=np.float64)
    scale = math.pi / window * middle
    first, at, last = scale * _parabola(seen, places, window)
    bend = 0.5 * (first + last) - at
    p: Signal = np.array([at + bend / 5.0, (last - first) / 6.0, bend * 2.0 / 15.0])
    _refine(z, p, n // window)
    return p
