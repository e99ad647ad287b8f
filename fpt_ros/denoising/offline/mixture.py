"""Impulses and white noise told apart by EM around any smoother: the frame of ``auto``.

The residual r = y - f is taken as (1-p) N(0, s^2) + p/2 N(m, s^2 + t^2) + p/2 N(-m, s^2 + t^2):
impulses of both signs and of a typical size m, as many sources have; m = 0 where they have none.
Each round::

    w = P(inlier | r),    z = f + w (y - f),    f = core(z, s)

with p in [0.001, 0.15], t >= s, m^2 + t^2 >= 9 s^2, and s = sqrt(sum w r^2 / (sum w - df)) kept
within [1, 1.2] MAD(z), that MAD within [0.7, 1.1] of the one before. Where a sample is missing
w = 0.

Impulses come alone: next to a likely impulse of the same sign, p is lowered by exp(-2).
Otherwise a narrow peak of the signal would pass for a burst of impulses.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from fpt_ros.denoising.offline import Mask, Sigma, Signal, quantisation
from fpt_ros.denoising.offline.noise import hampel, noise_sigma
from fpt_ros.denoising.offline.spectral_floor import level

Core = Callable[[Signal, Sigma], tuple[Signal, float]]
"""(z, sigma) -> (estimate, degrees of freedom)."""

ROUNDS, FEW_ROUNDS = 12, 4
LEAST_SHARE, MOST_SHARE = 1e-3, 0.15
CLOSE = 0.01
"""EM ends when the estimate's RMS change is below this share of s."""
ALONE = 2.0
FAINTEST = 1e-7
"""Noise below this share of the signal's standard deviation is taken as this: none."""


@dataclass(frozen=True)
class Noise:
    """The mixture: share p of impulses, s of all samples, t and m of the impulses (unit of y).

    The standard deviation of a sample is s times the ``profile``, shape (n,).
    """

    p: float
    s: float
    t: float
    m: float = 0.0
    profile: Sigma = 1.0

    @property
    def sigma(self) -> Sigma:
        """Standard deviation of the samples that are no impulses, unit of y."""
        return self.s * self.profile

    def _logits(self, r: Signal, present: Mask) -> tuple[Signal, Signal]:
        """Log of P(impulse) / P(none) for each residual, and by how much its neighbours lowered it.

        Three mean-field rounds: more change nothing that counts.
        """
        narrow = np.square(self.sigma)
        wide = narrow + self.t**2
        size = np.abs(r)
        alone = np.full(len(r), math.log(0.5 * self.p) - math.log1p(-self.p))
        alone += 0.5 * (r**2 / narrow - (size - self.m) ** 2 / wide + np.log(narrow / wide))
        alone += np.log1p(np.exp(-2.0 * self.m * size / wide))  # the impulse of the other sign
        lowered = np.zeros(len(r))
        for _ in range(3):
            impulse = np.where(present, _logistic(alone - lowered), 0.0) * np.sign(r)
            pair = np.maximum(impulse[:-1] * np.sign(r[1:]), 0.0)
            lowered = np.zeros(len(r))
            lowered[1:] += pair
            lowered[:-1] += np.maximum(impulse[1:] * np.sign(r[:-1]), 0.0)
            lowered *= ALONE
        return alone - lowered, lowered

    def inlier(self, r: Signal, present: Mask) -> Signal:
        """P(no impulse | r), 0 where a sample is missing."""
        return np.where(present, _logistic(-self._logits(r, present)[0]), 0.0)

    def log_likelihood(self, r: Signal, present: Mask) -> float:
        """Sum over the present samples of the logarithm of the density at ``r``."""
        logits, lowered = self._logits(r, present)
        narrow = np.square(self.sigma)
        p = self.p * np.exp(-lowered)
        none = np.log1p(-p) - 0.5 * (r**2 / narrow + np.log(2 * math.pi * narrow))
        # the logit is relative to 1 - self.p
        density = none + np.logaddexp(0.0, logits + math.log1p(-self.p) - np.log1p(-p))
        return float(np.sum(density[present]))


def _logistic(x: Signal) -> Signal:
    return np.asarray(1.0 / (1.0 + np.exp(-np.clip(x, -700.0, 700.0))))


@dataclass(frozen=True)
class Start:
    """The signal with obvious impulses removed.

    Attributes:
        z: cleaned samples, shape (n,).
        sigma: level of the noise of ``z``, unit of y.
        outlier: True where a sample was replaced.
        profile: how the noise varies, shape (n,), or 1.
        least: least sigma there can be, unit of y.
        step: of rounding, unit of y; 0: none.
        inflation: by how much the noise is stronger at low frequencies than ``level`` sees.
    """

    z: Signal
    sigma: float
    outlier: Mask
    profile: Sigma = 1.0
    least: float = 0.0
    step: float = 0.0
    inflation: float = 1.0

    def level(self, z: Signal, present: Mask) -> float:
        """The level of the noise of ``z`` where the profile is 1."""
        found = max(level(z / self.profile, present), self.least)
        return self.inflation * quantisation.trusted(found, self.step)


@dataclass(frozen=True)
class Fit:
    """What EM found with one core.

    Attributes:
        estimate: f, shape (n,).
        z: the completed data that f was fitted to, shape (n,).
        df: degrees of freedom of f.
        noise: the mixture.
    """

    estimate: Signal
    z: Signal
    df: float
    noise: Noise


def start(y: Signal, present: Mask, step: float = 0.0) -> Start:
    """Hampel (half-width 2, 3 sigma), twice, the scale at least the noise of the pass before.

    Args:
        y: samples, shape (n,).
        present: False where a sample is missing.
        step: of rounding, unit of y; 0: none.
    """
    least = quantisation.floor(step)
    z, _ = hampel(y, 2, noise_sigma(y, present))
    z, outlier = hampel(y, 2, max(noise_sigma(z, present), least))
    least = max(least, FAINTEST * float(np.std(y)))
    sigma = quantisation.trusted(max(level(z, present), least), step)
    return Start(z, sigma, outlier & present, 1.0, least, step)


def varying(y: Signal, present: Mask, begin: Start, profile: Signal) -> Start:
    """``begin`` again where the noise varies: Hampel's scale is at least the local one."""
    local = begin.level(begin.z / profile, present)
    z, outlier = hampel(y / profile, 2, local)
    z = z * profile
    sigma = max(level(z / profile, present), begin.least)
    return Start(z, sigma, outlier & present, profile, begin.least)


def first_noise(y: Signal, f: Signal, begin: Start, present: Mask) -> Noise:
    """The mixture that belongs to the samples that Hampel replaced."""
    share = float(np.sum(begin.outlier)) / max(1, int(present.sum()))
    p = min(max(share, LEAST_SHARE), MOST_SHARE)
    size = np.abs(y - f)[begin.outlier] if begin.outlier.any() else np.zeros(1)
    power, m = float(np.mean(size**2)), float(np.mean(size))
    return _noise(p, begin.sigma, power, m, begin.profile)


def _noise(p: float, s: float, power: float, m: float, profile: Sigma) -> Noise:
    """The mixture whose impulses have the mean square ``power`` and, if that allows it, size m."""
    power = max(power, 9.0 * s**2)
    t = math.sqrt(max(power - m**2, s**2))
    return Noise(p, s, t, math.sqrt(max(power - t**2, 0.0)), profile)


def next_noise(
    y: Signal, f: Signal, z: Signal, w: Signal, df: float, present: Mask, begin: Start, old: Noise
) -> Noise:
    """The M step: the mixture of the residuals y - f with the weights w of the inliers."""
    size = np.abs(y - f)
    square = size**2
    inliers = float(np.sum(w))
    scale = min(max(begin.level(z, present), 0.7 * begin.sigma), 1.1 * begin.sigma)
    s = math.sqrt(
        float(np.sum(w * square / np.square(begin.profile)))
        / max(inliers - df, 0.05 * inliers, 1e-300)
    )
    s = min(max(s, scale), 1.2 * scale)
    out = np.where(present, 1.0 - w, 0.0)
    outliers = max(float(np.sum(out)), 1e-9)
    p = min(max(outliers / max(1, int(present.sum())), LEAST_SHARE), MOST_SHARE)
    sign = np.tanh(old.m * size / (np.square(old.sigma) + old.t**2))  # P(its own) - P(the other)
    m = float(np.sum(out * size * sign)) / outliers
    return _noise(p, s, float(np.sum(out * square)) / outliers - s**2, m, begin.profile)


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
        begin: of :func:`start`.
        z: completed data to begin with; default: those of ``begin``.
        rounds: of EM, at most.
    """
    z = begin.z if z is None else z
    f, df = core(z, begin.sigma * begin.profile)
    noise = first_noise(y, f, begin, present)
    for _ in range(rounds):
        before, s = f, noise.s
        sigma = noise.sigma
        w = noise.inlier(y - f, present)
        z = f + w * (y - f)
        f, df = core(z, sigma)
        noise = next_noise(y, f, z, w, df, present, begin, noise)
        if np.mean((f - before) ** 2) < (CLOSE * s) ** 2:
            break
    return Fit(f, z, df, noise)
