"""Savitzky-Golay filter (thesis section 6.1): a polynomial fitted to a sliding window.

With J_ij = x_i^j, i = 1 .. M = 2m + 1, j = 0 .. k, x = -m .. m, the coefficients of the fit are
(J^T J)^{-1} J^T y, so the columns of

    G = J (J^T J)^{-1}                                              (6.9)

are the weights of the samples: column i times i!/dt^i gives the i-th derivative where x = 0. Near
the ends the polynomial of the first or last whole window is evaluated off its centre. Table 6.1 is
reproduced to its four decimals.

Misprints corrected: (6.1) sums over the index of the result and shifts by the degree, it is g_l =
sum_i c_i y_{l+i}; (6.5) is the equation J^T J a = J^T y; a_0 in (6.7) is the first component of the
right-hand side; (6.8) has no modulus; (6.9) lacks the inverse. For the symmetric window the degrees
2 and 3, or 4 and 5, have the same smoother.

scipy.signal.savgol_filter does the same, but fits powers of whole sample numbers: for M = 361, k =
5 its weights of the newest sample are off by 1e-5. Here x is scaled to [-1, 1].
"""

import math
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from fpt_ros.denoising.offline import Mask, Method, Signal
from fpt_ros.errors import BadInput
from fpt_ros.parameters import Parameter, Values, integer

WINDOW = Parameter("window", "samples of the window, odd", 35, minimum=1, maximum=100_001)
DEGREE = Parameter("degree", "degree of the polynomial", 3, minimum=0, maximum=15)


def check(window: int, degree: int, least_degree: int = 0) -> None:
    """Refuse windows and degrees that define no filter.

    Raises:
        BadInput: even window, degree >= window, or a degree below ``least_degree``.
    """
    if window < 1 or window % 2 == 0:
        raise BadInput(f"window = {window} is not valid: it takes an odd number of samples")
    if not least_degree <= degree:
        raise BadInput(f"degree = {degree} is not valid: at least {least_degree} is needed here")
    if degree >= window:
        raise BadInput(
            f"degree = {degree} is not valid for a window of {window} samples: it has to be less "
            "than the window"
        )


@lru_cache(maxsize=256)
def _fit(window: int, degree: int) -> NDArray[np.float64]:
    """(J^T J)^{-1} J^T, shape (degree + 1, window), of x in [-1, 1] around the window's centre."""
    Q, R = np.linalg.qr(_powers(window, degree))
    return np.asarray(np.linalg.solve(R, Q.T))


def _powers(window: int, degree: int, derivative: int = 0) -> NDArray[np.float64]:
    """J, shape (window, degree + 1), or a derivative of its columns, of x in [-1, 1]."""
    x = np.linspace(-1.0, 1.0, window) if window > 1 else np.zeros(1)
    J = np.zeros((window, degree + 1))
    for j in range(derivative, degree + 1):
        J[:, j] = math.perm(j, derivative) * x ** (j - derivative)
    return J


def weights(window: int, degree: int, position: float) -> NDArray[np.float64]:
    """G of (6.9), shape (window, degree + 1), with x = 0 at the sample number ``position``.

    Column i gives the i-th Taylor coefficient per sample^i there. Oldest sample first; ``position``
    may lie off the samples.
    """
    centre = 0.5 * (window - 1)
    half = max(centre, 1.0)
    at = (position - centre) / half
    shift = np.zeros((degree + 1, degree + 1))
    for i in range(degree + 1):
        for j in range(i, degree + 1):
            shift[i, j] = math.comb(j, i) * at ** (j - i) / half**i
    return np.asarray((shift @ _fit(window, degree)).T)


def kernel(
    window: int, degree: int, derivative: int = 0, position: float | None = None, dt: float = 1.0
) -> NDArray[np.float64]:
    """Weights of the samples that give a derivative, shape (window,); at the centre by default."""
    if derivative > degree:
        return np.zeros(window)
    at = 0.5 * (window - 1) if position is None else position
    scale = math.factorial(derivative) / dt**derivative
    return weights(window, degree, at)[:, derivative] * scale


def smooth(
    y: Signal, window: int, degree: int, derivative: int = 0, dt: float = 1.0
) -> NDArray[np.float64]:
    """The derivative (0: the smoothed signal) of ``y`` at all of its samples, shape (n,).

    Raises:
        BadInput: even window, degree >= window, or more samples in the window than in ``y``.
    """
    check(window, degree)
    if window > len(y):
        raise BadInput(f"a window of {window} needs at least as many samples, there are {len(y)}")
    half = window // 2
    offset = y[half]  # of which a derivative knows nothing: fewer digits are lost
    centred = y - offset
    out = np.empty(len(y))
    out[half : len(y) - half] = np.convolve(
        centred, kernel(window, degree, derivative)[::-1], mode="valid"
    )
    if half:
        J = _powers(window, degree, derivative) / max(float(half), 1.0) ** derivative
        fit = _fit(window, degree)
        out[:half] = J[:half] @ (fit @ centred[:window])
        out[-half:] = J[-half:] @ (fit @ centred[-window:])
    return np.asarray(out / dt**derivative + (offset if derivative == 0 else 0.0))


def gain(window: int, degree: int) -> float:
    """c_0: the weight of a sample in its own estimate, and the share of the noise power left."""
    return float(own_weights(window, degree)[window // 2])


@lru_cache(maxsize=256)
def own_weights(window: int, degree: int) -> NDArray[np.float64]:
    """Weight of each sample of one window in its own estimate: c_0 in the middle, more outward."""
    return np.asarray(np.sum(_powers(window, degree) * _fit(window, degree).T, axis=1))


def _estimate(y: Signal, present: Mask, values: Values) -> Signal:
    return smooth(y, integer(values, "window"), integer(values, "degree"))


def _shortest(values: Values) -> int:
    check(integer(values, "window"), integer(values, "degree"))
    return integer(values, "window")


SAVGOL = Method((WINDOW, DEGREE), _estimate, _shortest)
