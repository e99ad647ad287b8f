"""How strong the noise is: robust estimates, which neither the signal nor impulses mislead.

All standard deviations come from the median of absolute values of a detail band in which a smooth
signal vanishes: sigma = median(|d|) / 0.6745. The thesis prints the median without the absolute
value (below (5.1)), which is about 0 for any symmetric band.
"""

import math

import numpy as np
import pywt
from numpy.typing import NDArray

Signal = NDArray[np.float64]
Mask = NDArray[np.bool_]

MAD = 0.6745
"""Median of |x| of a standard normal x, as the thesis rounds it."""

_DETAIL = np.asarray(pywt.Wavelet("db2").dec_hi)
_THIRD = np.array([-1.0, 3.0, -3.0, 1.0]) / np.sqrt(20.0)


def mad(x: Signal) -> float:
    """median(|x|) / 0.6745: the standard deviation of symmetric normal ``x``, in its unit."""
    return float(np.median(np.abs(x))) / MAD if len(x) else 0.0


def noise_sigma(y: Signal, present: Mask | None = None) -> float:
    """MAD of the undecimated finest db2 detail: blind to lines, robust to impulses below 10 %.

    Coefficients that touch a missing sample do not count.
    """
    return _band_sigma(y, present, _DETAIL)


def finest_detail(y: Signal) -> Signal:
    """The undecimated finest db2 detail, shape (n - 3,): the noise of a slow signal."""
    return np.convolve(y, _DETAIL, mode="valid")


def third_difference_sigma(y: Signal, present: Mask | None = None) -> float:
    """MAD(third difference) / sqrt(20): blind to parabolas."""
    return _band_sigma(y, present, _THIRD)


def _band_sigma(y: Signal, present: Mask | None, kernel: Signal) -> float:
    if len(y) < len(kernel):
        return mad(np.diff(y)) / math.sqrt(2.0)
    band = np.convolve(y, kernel, mode="valid")
    if present is not None and not present.all():
        whole = np.convolve(present, np.ones(len(kernel)), mode="valid") > len(kernel) - 0.5
        if whole.any():
            band = band[whole]
    return mad(band)


def neighbourhoods(y: Signal, half: int) -> Signal:
    """The 2 half + 1 samples around each one, reflected at the ends; shape (n, 2 half + 1)."""
    padded = np.pad(y, half, mode="reflect" if len(y) > half else "symmetric")
    return np.lib.stride_tricks.sliding_window_view(padded, 2 * half + 1)


def hampel(y: Signal, half: int, least_scale: float, factor: float = 3.0) -> tuple[Signal, Mask]:
    """Replace outliers by the median of their neighbourhood.

    Args:
        y: samples, shape (n,).
        half: half-width of the neighbourhood [samples].
        least_scale: lower bound of the local scale, unit of y: a flat neighbourhood is no reason
            to reject.
        factor: a sample this many local scales off its median is an outlier.

    Returns:
        The cleaned samples, and True at the samples that were replaced.
    """
    around = neighbourhoods(y, half)
    middle = np.median(around, axis=1)
    scale = np.median(np.abs(around - middle[:, None]), axis=1) / MAD
    outlier = np.abs(y - middle) > factor * np.maximum(scale, least_scale)
    return np.where(outlier, middle, y), outlier
