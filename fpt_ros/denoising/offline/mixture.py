"""Impulses and white noise told apart by EM around any smoother: the frame of ``auto``.

The residual r = y - f is taken as (1-p) N(0, s^2) + p N(0, s^2 + t^2). Each round::

    w = P(inlier | r),    z = f + w (y - f),    f = core(z, s)

with p in [0.001, 0.15], t^2 >= 9 s^2, and s = sqrt(sum w r^2 / (sum w - df)) kept within [1, 1.2]
MAD(z), that MAD within [0.7, 1.1] of the one before. Where a sample is missing w = 0.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from fpt_ros.denoising.offline import Mask, Signal
from fpt_ros.denoising.offline.noise import hampel, noise_sigma

Core = Callable[[Signal, float], tuple[Signal, float]]
"""(z, sigma) -> (estimate, degrees of freedom)."""

ROUNDS = 12
LEAST_SHARE, MOST_SHARE = 1e-3, 0.15
CLOSE = 0.01
"""EM ends when the estimate's RMS change is below this share of s."""


@dataclass(frozen=True)
class Noise:
    """The mixture: share p of impulses, s of all samples, and t of the impulses (unit of y)."""

    p: float
    s: float
    t: float

    def log_parts(self, r: Signal) -> tuple[Signal, Signal]:
        """Logarithms of both parts of the density at ``r``."""
        narrow, wide = self.s**2, self.s**2 + self.t**2
        inlier = math.log1p(-self.p) - 0.5 * (r**2 / narrow + math.log(2 * math.pi * narrow))
        outlier = math.log(self.p) - 0.5 * (r**2 / wide + math.log(2 * math.pi * wide))
        return inlier, outlier

    def inlier(self, r: Signal) -> Signal:
        """P(no impulse | r)."""
        inlier, outlier = self.log_parts(r)
        return np.asarray(1.0 / (1.0 + np.exp(np.clip(outlier - inlier, -700.0, 700.0))))

    def log_likelihood(self, r: Signal) -> float:
        """Sum of the logarithms of the density at ``r``."""
        return float(np.sum(np.logaddexp(*self.log_parts(r))))


@dataclass(frozen=True)
class Start:
    """The signal with obvious impulses removed.

    Attributes:
        z: cleaned samples, shape (n,).
        sigma: MAD of the finest detail of ``z``, unit of y.
        outlier: True where a sample was replaced.
    """

    z: Signal
    sigma: float
    outlier: Mask


@dataclass(frozen=True)
class Fit:
    """What EM found with one core.

    Attributes:
        estimate: f, shape (n,).
        z: the completed data that f was fitted to, shape (n,).
        weight: P(inlier) of every sample, 0 where it is missing.
        df: degrees of freedom of f.
        noise: the mixture.
    """

    estimate: Signal
    z: Signal
    weight: Signal
    df: float
    noise: Noise


def start(y: Signal, present: Mask) -> Start:
    """Hampel (half-width 2, 3 sigma), twice, the scale at least the noise of the pass before."""
    z, outlier = hampel(y, 2, noise_sigma(y, present))
    z, outlier = hampel(y, 2, noise_sigma(z, present))
    return Start(z, noise_sigma(z, present), outlier & present)


def first_noise(y: Signal, f: Signal, begin: Start, present: Mask) -> Noise:
    """The mixture that belongs to the samples that Hampel replaced."""
    share = float(np.sum(begin.outlier)) / max(1, int(present.sum()))
    p = min(max(share, LEAST_SHARE), MOST_SHARE)
    power = float(np.mean((y - f)[begin.outlier] ** 2)) if begin.outlier.any() else 0.0
    return Noise(p, begin.sigma, math.sqrt(max(power, 9.0 * begin.sigma**2)))


def next_noise(y: Signal, fit: Fit, present: Mask, sigma0: float) -> Noise:
    """The M step."""
    r, w = y - fit.estimate, fit.weight
    inliers = float(np.sum(w))
    scale = min(max(noise_sigma(fit.z, present), 0.7 * sigma0), 1.1 * sigma0)
    s = math.sqrt(float(np.sum(w * r**2)) / max(inliers - fit.df, 0.05 * inliers, 1e-300))
    s = min(max(s, scale), 1.2 * scale)
    out = np.where(present, 1.0 - w, 0.0)
    outliers = float(np.sum(out))
    p = min(max(outliers / max(1, int(present.sum())), LEAST_SHARE), MOST_SHARE)
    spread = float(np.sum(out * r**2)) / outliers - s**2 if outliers > 1e-9 else 0.0
    return Noise(p, s, math.sqrt(max(spread, 9.0 * s**2)))


def fit(
    y: Signal,
    present: Mask,
    core: Core,
    begin: Start,
    z: Signal | None = None,
    rounds: int = ROUNDS,
) -> Fit:
    """EM around ``core``.

    Args:
        y: samples, shape (n,), missing ones filled with anything near.
        present: False where a sample is missing.
        core: the smoother.
        begin: of :func:`start`, with sigma > 0.
        z: completed data to begin with; default: those of ``begin``.
        rounds: at most.
    """
    f, df = core(begin.z if z is None else z, begin.sigma)
    noise = first_noise(y, f, begin, present)
    found = Fit(f, y, np.ones(len(y)), df, noise)
    for _ in range(rounds):
        w = np.where(present, noise.inlier(y - found.estimate), 0.0)
        completed = found.estimate + w * (y - found.estimate)
        f, df = core(completed, noise.s)
        change = math.sqrt(float(np.mean((f - found.estimate) ** 2)))
        found = Fit(f, completed, w, df, noise)
        noise = next_noise(y, found, present, begin.sigma)
        if change < CLOSE * noise.s:
            break
    return Fit(found.estimate, found.z, found.weight, found.df, noise)
