"""Improved denoising (thesis 5.1.2): DWT, robust loess on every band, inverse DWT.

The orthogonal DWT of one level keeps white noise white and an impulse an outlier of a few
coefficients, which the bisquare weights of :mod:`loess` reject. The window is the one parameter
that matters: 61 approximation coefficients suit slow signals, 31 and less fast ones; narrow peaks
are rejected as outliers whatever it is.

Corrections: "6.) repeat step 1" would redo the DWT: step 2 is repeated with the weights w delta.
The degree, "linear or quadratic", has to be quadratic (17.2 against 13.2 dB on sines). A smooth
curve through the DETAIL leaves a slowly varying non-zero detail, which the inverse DWT turns into a
ripple of the highest frequency: ``detail = zero`` drops it (19.9 dB), ``detail = significant``
keeps it where it exceeds the universal threshold of its own standard error.
"""

import numpy as np

from fpt_ros.denoising.offline import Mask, Method, Signal
from fpt_ros.denoising.offline.loess import loess
from fpt_ros.denoising.offline.noise import mad
from fpt_ros.denoising.offline.thresholding import WAVELET, compose, decompose
from fpt_ros.denoising.offline.universal import threshold
from fpt_ros.parameters import Parameter, Values, integer, word

WINDOW = 61
PARAMETERS = (
    WAVELET,
    Parameter("level", "levels of the wavelet transform", 1, minimum=1, maximum=16),
    Parameter("window", "samples of a band in the local fit", WINDOW, minimum=5, maximum=100001),
    Parameter("degree", "degree of the local polynomial", 2, minimum=1, maximum=2),
    Parameter(
        "detail",
        "fit: smooth the details too (thesis); zero: drop them; significant: keep what is real",
        "fit",
        choices=("fit", "zero", "significant"),
    ),
)


def improved(
    y: Signal,
    window: int = WINDOW,
    wavelet: str = "sym8",
    level: int = 1,
    degree: int = 2,
    detail: str = "fit",
) -> Signal:
    """The estimate, shape (n,), of ``y``; the arguments are those of the method."""
    bands = decompose(y, wavelet, level)
    sigma = mad(bands[-1])
    smooth = [loess(bands[0], window, degree)[0]]
    for band in bands[1:]:
        if detail == "zero":
            smooth.append(np.zeros(len(band)))
            continue
        fit, gain = loess(band, window, degree)
        if detail == "significant":
            fit = np.where(np.abs(fit) > threshold(len(band)) * sigma * np.sqrt(gain), fit, 0.0)
        smooth.append(fit)
    return compose(smooth, wavelet, len(y))


def _estimate(y: Signal, present: Mask, values: Values) -> Signal:
    return improved(
        y,
        integer(values, "window"),
        word(values, "wavelet"),
        integer(values, "level"),
        integer(values, "degree"),
        word(values, "detail"),
    )


IMPROVED = Method(PARAMETERS, _estimate, shortest=lambda _: 8)
