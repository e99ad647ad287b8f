"""What a user of other libraries would take, to be compared with: not of the thesis.

scikit-image's wavelet denoising with its thresholds BayesShrink and VisuShrink, PyWavelets' soft
threshold at the universal bound as its documentation does it, a median filter before
Savitzky-Golay, and lowess of statsmodels. scikit-image and statsmodels are needed for these alone.
"""

import math
from importlib import import_module
from typing import Any

import numpy as np
import pywt
from scipy.signal import medfilt, savgol_filter

from fpt_ros.denoising.offline import Mask, Method, Signal
from fpt_ros.denoising.offline.thresholding import soft
from fpt_ros.errors import BadInput
from fpt_ros.extras import remedy
from fpt_ros.parameters import Parameter, Values, integer, word

WAVELET = Parameter("wavelet", "wavelet by its name in PyWavelets", "sym8")
LEVEL = Parameter("level", "levels of the wavelet transform", 5, minimum=1, maximum=16)


def _library(module: str) -> Any:
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        raise BadInput(remedy(error) or str(error)) from None


def _scikit_image(kind: str) -> Method:
    """``denoise_wavelet``, which estimates the noise by itself."""

    def estimate(y: Signal, present: Mask, values: Values) -> Signal:
        restoration = _library("skimage.restoration")
        wavelet = word(values, "wavelet")
        if wavelet not in pywt.wavelist(kind="discrete"):
            raise BadInput(f"wavelet = '{wavelet}' is none of PyWavelets' discrete wavelets")
        return np.asarray(
            restoration.denoise_wavelet(
                y, wavelet=wavelet, mode="soft", method=kind, rescale_sigma=True
            )
        )

    return Method((WAVELET,), estimate, shortest=lambda _: 16)


def _soft_universal(y: Signal, present: Mask, values: Values) -> Signal:
    deepest = pywt.dwt_max_level(len(y), "sym8")
    bands = pywt.wavedec(y, "sym8", level=max(1, min(integer(values, "level"), deepest)))
    bound = float(np.median(np.abs(bands[-1]))) / 0.6745 * math.sqrt(2.0 * math.log(len(y)))
    # not pywt.threshold, which makes NaN of a 0 at the threshold 0 (PyWavelets issue 866)
    kept = [bands[0], *(soft(band, bound) for band in bands[1:])]
    return np.asarray(pywt.waverec(kept, "sym8")[: len(y)])


def _median_savgol(y: Signal, present: Mask, values: Values) -> Signal:
    return np.asarray(savgol_filter(medfilt(y, 5), 35, 3))


def _lowess(y: Signal, present: Mask, values: Values) -> Signal:
    smoothers = _library("statsmodels.nonparametric.smoothers_lowess")
    share = min(1.0, integer(values, "window") / len(y))
    index = np.arange(len(y), dtype=np.float64)
    return np.asarray(smoothers.lowess(y, index, frac=share, it=3, return_sorted=False))


BAYESSHRINK = _scikit_image("BayesShrink")
VISUSHRINK = _scikit_image("VisuShrink")
SOFT_UNIVERSAL = Method((LEVEL,), _soft_universal, shortest=lambda _: 16)
MEDIAN_SAVGOL = Method((), _median_savgol, shortest=lambda _: 35)
LOWESS = Method(
    (Parameter("window", "samples of the local fit", 61, minimum=5, maximum=100_001),),
    _lowess,
    shortest=lambda _: 8,
)
