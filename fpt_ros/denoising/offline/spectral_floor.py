"""The noise level where the signal has high frequencies: the floor of the spectrogram.

The finest detail of a wavelet (:mod:`noise`) holds the noise alone only if the signal is slow. A
signal of few frequencies at a time, however high, leaves most cells of its spectrogram empty: in
white noise of sigma their power is sigma^2 Exp(1), and a low quantile of all cells gives sigma.
Jumps fill the cells around them, where the wavelet's median is the better: the lesser of both is
the level.
"""

import math

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import gaussian_filter1d, median_filter

from fpt_ros.denoising.offline import Mask, Signal
from fpt_ros.denoising.offline.noise import MAD, finest_detail, noise_sigma

WINDOW = 64
"""Samples of a frame, a quarter of them the step; less of short records."""
QUANTILE = 0.3
LOWEST = 2
"""Cells below this frequency [per frame] hold signals of all kinds."""
SHARE = 0.8
"""Of the wavelet's estimate: the floor counts if it is below this; else it is but less exact."""
SMOOTH = 1.0
"""Standard deviation of the window of the profile [frames of a whole window]."""
LEAST_RATIO = 3.0
"""Of the greatest to the least local level: less is one level."""
LONG = 4096
"""Frames that are looked at for the level of the whole."""


def _frames(n: int) -> tuple[int, int]:
    """Window and step [samples]."""
    window = int(min(WINDOW, max(16, n // 8)))
    return window, max(1, window // 4)


def _power(y: Signal, starts: NDArray[np.int64], window: int) -> Signal:
    """Power of the cells, each frame without its line, shape (frames, cells); E = sigma^2."""
    frames = y[starts[:, None] + np.arange(window)]
    frames = frames - frames.mean(axis=1, keepdims=True)
    t = np.linspace(-1.0, 1.0, window)
    frames -= np.outer(frames @ t / (t @ t), t)
    taper = np.hanning(window + 2)[1:-1]
    taper /= math.sqrt(float(taper @ taper))
    return np.asarray(np.abs(np.fft.rfft(frames * taper, axis=1)[:, LOWEST:-1]) ** 2)


def level(y: Signal, present: Mask | None = None) -> float:
    """Standard deviation of the white noise of ``y``: the lesser of wavelet and spectrogram."""
    detail = noise_sigma(y, present)
    window, step = _frames(len(y))
    if len(y) < 2 * window:
        return detail
    starts = np.arange(0, len(y) - window + 1, step)
    if len(starts) > LONG:
        starts = np.linspace(0, len(y) - window, LONG).astype(int)
    floor = float(np.quantile(_power(y, starts, window), QUANTILE))
    sigma = math.sqrt(floor / -math.log1p(-QUANTILE))
    return sigma if sigma < SHARE * detail else detail


def flatness(noise: Signal) -> float:
    """Geometric over arithmetic mean of the power in a frame, the median of all frames.

    Of white noise it is about exp(-0.577) = 0.56 (spectral flatness: Johnston, IEEE J. Sel. Areas
    Commun. 6, 1988); of one frequency at a time, as of a chirp over the whole band, it is far less
    in each frame though the whole has a flat spectrum.
    """
    window, step = _frames(len(noise))
    starts = np.arange(0, len(noise) - window + 1, step)
    if len(starts) > LONG:
        starts = np.linspace(0, len(noise) - window, LONG).astype(int)
    power = _power(noise, starts, window)
    mean = power.mean(axis=1)
    known = mean > 0.0
    if not known.any():
        return 1.0
    logs = np.log(power[known] / mean[known, None] + 1e-12).mean(axis=1)
    return float(np.median(np.exp(logs)))


def profile(y: Signal, present: Mask, least: float = 0.0) -> Signal:
    """How the level varies along ``y``: of geometric mean 1, shape (n,); ones where it does not.

    Args:
        y: samples without impulses, shape (n,).
        present: False where a sample was missing.
        least: least level there can be, as by rounding, unit of y.
    """
    n = len(y)
    window, step = _frames(n // 2)
    flat = np.ones(n)
    if n < 4 * window:
        return flat
    starts = np.arange(0, n - window + 1, step)
    middle = starts + 0.5 * (window - 1)
    power = _power(y, starts, window)
    floor = np.quantile(power, QUANTILE, axis=1) / -math.log1p(-QUANTILE)
    detail = np.abs(finest_detail(y))
    local = np.array([np.median(detail[a : a + window - 3]) for a in starts]) / MAD
    floor = np.sqrt(floor)
    lower = np.where(floor < SHARE * local, floor, local)
    if np.median(lower) <= least:
        return flat
    logs = np.log(np.maximum(lower, max(least, 1e-3 * float(np.median(lower)))))
    # a gap that was healed has no noise: its frames know nothing
    known = np.array([present[a : a + window].mean() > 0.7 for a in starts])
    if known.sum() < 8:
        return flat
    logs = np.interp(middle, middle[known], logs[known])
    logs = median_filter(logs, 5, mode="nearest")
    logs = gaussian_filter1d(logs, SMOOTH * window / step / 2.0, mode="nearest")
    if logs.max() - logs.min() < math.log(LEAST_RATIO):
        return flat
    at = np.interp(np.arange(n), middle, logs)
    return np.asarray(np.exp(at - at.mean()))
