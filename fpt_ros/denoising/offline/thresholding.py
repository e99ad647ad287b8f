"""Wavelet shrinkage (thesis section 5.1): what the four threshold rules have in common.

DWT, soft threshold of the details, inverse DWT; PyWavelets does the transforms. A rule gives the
threshold nu of coefficients x that have been divided by the noise's sigma.

Misprints corrected: y_ij = omega_ij eps_i (line 1322) should be omega = W y = W f + W eps, since
the noise is additive; "set their value to the threshold level" is neither hard nor soft: soft is
sign(x) max(|x| - nu, 0). sigma_MAD = median(|d_1|) / 0.6745 of the FINEST detail: the print lacks
the absolute value, without which the median of any symmetric band is about 0.
"""

import math
import warnings
from collections.abc import Callable

import numpy as np
import pywt
from numpy.typing import NDArray

from fpt_ros.denoising.offline import Mask, Method, Signal
from fpt_ros.denoising.offline.noise import mad
from fpt_ros.parameters import Parameter, Values, integer, word

Rule = Callable[[Signal, int], float]
"""(coefficients / sigma, length of the signal) -> threshold in units of sigma."""

WAVELETS = (
    "haar",
    *pywt.wavelist("db"),
    *pywt.wavelist("sym"),
    *pywt.wavelist("coif"),
)
"""The orthogonal ones: white noise stays white in the coefficients."""

WAVELET = Parameter("wavelet", "orthogonal wavelet", "sym8", choices=WAVELETS)
NOISE = Parameter(
    "noise",
    "sln: one sigma for all levels; mln: one for each level",
    "sln",
    choices=("sln", "mln"),
)


def decompose(y: Signal, wavelet: str, level: int) -> list[Signal]:
    """Coefficients [a_J, d_J, .., d_1] of the DWT with symmetric extension, at most log2(n) levels.

    Table 5.1 uses 8 levels of 1024 samples, where bands are shorter than the filter: PyWavelets
    warns of that, and is silenced.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", UserWarning)
        deepest = max(1, min(level, int(math.log2(len(y)))))
        return list(pywt.wavedec(y, wavelet, mode="symmetric", level=deepest))


def compose(coefficients: list[Signal], wavelet: str, n: int) -> Signal:
    """The n samples that have these coefficients."""
    return np.asarray(pywt.waverec(coefficients, wavelet, mode="symmetric")[:n])


def soft(x: NDArray[np.float64], nu: float) -> NDArray[np.float64]:
    """sign(x) max(|x| - nu, 0)."""
    return np.sign(x) * np.maximum(np.abs(x) - nu, 0.0)


def shrink(y: Signal, rule: Rule, wavelet: str, level: int, noise: str = "sln") -> Signal:
    """DWT, soft threshold of every detail by ``rule``, inverse DWT; the approximation is kept.

    Args:
        y: samples, shape (n,).
        rule: threshold of coefficients in units of their sigma.
        wavelet: name of an orthogonal wavelet.
        level: levels of the DWT.
        noise: ``sln`` takes sigma from the finest detail, ``mln`` from each level.
    """
    n = len(y)
    bands = decompose(y, wavelet, level)
    finest = mad(bands[-1])
    for j in range(1, len(bands)):
        sigma = mad(bands[j]) if noise == "mln" else finest
        if sigma > 0:
            bands[j] = soft(bands[j], sigma * rule(bands[j] / sigma, n))
    return compose(bands, wavelet, n)


def method(rule: Rule, level: int) -> Method:
    """A method of the registry from a rule and the level of Table 5.1."""

    def estimate(y: Signal, present: Mask, values: Values) -> Signal:
        wavelet, depth = word(values, "wavelet"), integer(values, "level")
        return shrink(y, rule, wavelet, depth, word(values, "noise"))

    depth = Parameter("level", "levels of the wavelet transform", level, minimum=1, maximum=16)
    return Method((WAVELET, depth, NOISE), estimate)
