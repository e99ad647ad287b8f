"""A bank of Savitzky-Golay filters, mixed at each sample by Stein's estimate of their local risk.

Beyond the thesis: chapter 6 chooses degree and window of each part of the signal by rules on the
distances of extrema. Here the data choose. With s the result of a member and c_0 the weight of a
sample in its own estimate, the expectation of (y - s)^2 + 2 sigma^2 c_0 - sigma^2 is the member's
squared error. Its Gaussian mean over max(20, M/4) samples is the risk at a sample, and the members
are averaged with the weights exp(-15 (risk - least risk) / sigma^2).

The robust form begins with a Hampel filter, and replaces residuals beyond 3.2 sigma by the fit,
round by round.
"""

from functools import lru_cache

import numpy as np
from scipy.ndimage import gaussian_filter1d

from fpt_ros.denoising.offline import Mask, Method, Signal
from fpt_ros.denoising.offline.noise import hampel, third_difference_sigma
from fpt_ros.denoising.offline.savgol import own_weights, smooth
from fpt_ros.parameters import Parameter, Values, flag

DEGREES = (1, 3, 5)
WINDOWS = (5, 7, 9, 11, 15, 19, 25, 31, 41, 53, 69, 89, 115, 151)
SHARPNESS = 15.0
"""Of the weights, in units of 1/sigma^2: 60/4."""

ROUNDS = 6
OUTLIER = 3.2
"""Residual in units of sigma beyond which the fit takes the sample's place."""

ROBUST = Parameter("robust", "reject impulses", True)


@lru_cache(maxsize=1024)
def _own(n: int, window: int, degree: int) -> Signal:
    """Weight of each of n samples in its own estimate; greater near the ends."""
    half, own = window // 2, own_weights(window, degree)
    return np.concatenate((own[:half], np.full(n - 2 * half, own[half]), own[half + 1 :]))


def members(n: int) -> list[tuple[int, int]]:
    """(degree, window) of all filters that smooth n samples: at least two more than interpolate."""
    return [(k, M) for k in DEGREES for M in WINDOWS if k + 2 <= M <= n]


def bank(y: Signal, sigma: float) -> Signal:
    """The mixture for white noise of ``sigma``, shape (n,)."""
    n = len(y)
    candidates = members(n)
    if sigma <= 0.0 or not candidates:
        return y.copy()
    estimates = np.empty((len(candidates), n))
    risks = np.empty((len(candidates), n))
    for row, (degree, window) in enumerate(candidates):
        estimates[row] = smooth(y, window, degree)
        risk = (y - estimates[row]) ** 2 + sigma**2 * (2.0 * _own(n, window, degree) - 1.0)
        risks[row] = gaussian_filter1d(risk, max(20.0, window / 4.0), mode="reflect")
    mixed = np.exp(-SHARPNESS / sigma**2 * (risks - risks.min(axis=0)))
    return np.asarray(np.sum(mixed * estimates, axis=0) / np.sum(mixed, axis=0))


def robust_bank(y: Signal, present: Mask | None = None) -> Signal:
    """The mixture for white noise with impulses, shape (n,); sigma is estimated."""
    sigma = third_difference_sigma(y, present)
    z, _ = hampel(y, 3, sigma)
    estimate = bank(z, third_difference_sigma(z, present))
    for _ in range(ROUNDS - 1):
        sigma = third_difference_sigma(z, present)
        z = np.where(np.abs(y - estimate) > OUTLIER * sigma, estimate, y)
        estimate = bank(z, third_difference_sigma(z, present))
    return estimate


def _estimate(y: Signal, present: Mask, values: Values) -> Signal:
    if flag(values, "robust"):
        return robust_bank(y, present)
    return bank(y, third_difference_sigma(y, present))


SAVGOL_BANK = Method((ROBUST,), _estimate)
