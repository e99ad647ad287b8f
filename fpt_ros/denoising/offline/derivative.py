"""The derivative of an estimate by time.

Equal steps: a Savitzky-Golay filter of degree k + 2 over the estimate, k being the derivative. Its
window is the one of least generalised cross-validation on the record itself::

    GCV = mean((y - s)^2) / (1 - c_0)^2

with s what that filter smooths and c_0 the weight of a sample in its own estimate. So what noise is
left in the estimate is smoothed once more, by no more than the record allows; where the signal has
jumps, they are slopes of a window's width.

Unequal steps: the derivative of the Gaussian process (Matern 5/2), which has two.
"""

import numpy as np

from fpt_ros.denoising.offline import Record, Signal
from fpt_ros.denoising.offline.gaussian_process import Samples, fit
from fpt_ros.denoising.offline.kalman import UNKNOWN
from fpt_ros.denoising.offline.savgol import gain, smooth

WINDOWS = (5, 7, 9, 11, 15, 21, 31, 41, 61, 81, 121, 161, 241)
ROBUST = 20.0
"""Residuals count by the mean of the least 95 %: impulses have no say in the window."""


def window(record: Record, degree: int) -> int:
    """The window of least GCV among ``WINDOWS`` [samples]; the least that the degree allows."""
    y, n = record.y, len(record.y)
    allowed = [w for w in WINDOWS if degree + 2 <= w <= n] or [degree + 1 + degree % 2]
    best, least = allowed[0], np.inf
    for size in allowed:
        square = np.sort((y - smooth(y, size, degree))[record.present] ** 2)
        square = square[: max(1, int(len(square) * (1.0 - 1.0 / ROBUST)))]
        cost = float(square.mean()) / max(1.0 - gain(size, degree), 1e-9) ** 2
        if cost < least:
            best, least = size, cost
    return best


def differentiate(record: Record, estimate: Signal, derivative: int) -> Signal:
    """The derivative [unit of the estimate / mean step^k], shape (n,).

    Args:
        record: what was denoised.
        estimate: of its signal, shape (n,).
        derivative: k, 1 or 2.
    """
    if record.even:
        degree = derivative + 2
        if len(estimate) < degree + 2:
            return np.asarray(_differences(estimate, derivative))
        return smooth(estimate, window(record, degree), degree, derivative)
    middle = float(estimate.mean())
    known = np.where(record.present, 1.0, UNKNOWN)
    samples = Samples(record.y - middle, known, record.dt, 1e-7 * float(np.std(estimate)))
    return fit(samples, "smooth").smooth(samples, derivative)[0]


def _differences(estimate: Signal, derivative: int) -> Signal:
    out = estimate
    for _ in range(derivative):
        out = np.gradient(out) if len(out) > 1 else np.zeros_like(out)
    return out
