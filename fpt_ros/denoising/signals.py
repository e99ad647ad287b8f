"""Test signals, noise and metrics of the figures of chapters 5 and 6.

All signals are sampled at t = i/n, i = 0 .. n-1 [length of the record], dimensionless. Those of
chapter 5 have the standard deviation 0.62521: then the thesis's pair 23.5412 dB, RMSE 0.04159
(Table 5.1) is consistent; ``periodic`` is for healing. ``doppler6`` of chapter 6 is ``doppler``
with the standard deviation 0.7.

The success of a denoiser is SNR = 10 log10(var(f) / mean((estimate - f)^2)). The formula printed
below Table 5.1, var(estimate) / var(y - estimate), cannot measure it: a perfect denoiser scores
what the noisy signal had, and one that does nothing scores infinity.
"""

import math

import numpy as np
from numpy.typing import NDArray

from fpt_ros.errors import BadInput

Signal = NDArray[np.float64]

CHAPTER5 = ("sines", "doppler", "heavisine", "bumps", "blocks", "periodic")
CHAPTER6 = ("chirp", "doppler6", "spectro", "twotone")
STD5 = 0.62521
STD6 = 0.7
SNR_BEFORE = 2.2294
"""Table 5.1 [dB]."""

_JUMPS = (0.10, 0.13, 0.15, 0.23, 0.25, 0.40, 0.44, 0.65, 0.76, 0.78, 0.81)
_BLOCKS = (4.0, -5.0, 3.0, -4.0, 5.0, -4.2, 2.1, 4.3, -3.1, 2.1, -4.2)
_BUMPS = (4.0, 5.0, 3.0, 4.0, 5.0, 4.2, 2.1, 4.3, 3.1, 5.1, 4.2)
_WIDTHS = (0.005, 0.005, 0.006, 0.01, 0.01, 0.03, 0.01, 0.01, 0.005, 0.008, 0.005)
_LINES = (
    (0.08, 0.6, 0.012),
    (0.18, 1.0, 0.020),
    (0.27, 0.5, 0.010),
    (0.36, 0.8, 0.016),
    (0.47, 1.2, 0.025),
    (0.58, 0.4, 0.010),
    (0.67, 0.9, 0.014),
    (0.78, 0.7, 0.022),
    (0.90, 1.0, 0.012),
)
"""Position, height and half-width of the lines of ``spectro``."""


def _sines(t: Signal) -> Signal:
    f = np.sin(2 * np.pi * 2.3 * t)
    return f + 0.5 * np.sin(2 * np.pi * 5.1 * t + 0.7) + 0.25 * np.sin(2 * np.pi * 9.7 * t + 1.3)


def _doppler(t: Signal) -> Signal:
    return np.asarray(np.sqrt(t * (1 - t)) * np.sin(2 * np.pi * 1.05 / (t + 0.05)))


def _heavisine(t: Signal) -> Signal:
    return 4 * np.sin(4 * np.pi * t) - np.sign(t - 0.3) - np.sign(0.72 - t)


def _bumps(t: Signal) -> Signal:
    f = np.zeros_like(t)
    for place, height, width in zip(_JUMPS, _BUMPS, _WIDTHS, strict=True):
        f += height / (1 + np.abs((t - place) / width)) ** 4
    return f


def _blocks(t: Signal) -> Signal:
    f = np.zeros_like(t)
    for place, height in zip(_JUMPS, _BLOCKS, strict=True):
        f += height * (1 + np.sign(t - place)) / 2
    return f


def _periodic(t: Signal) -> Signal:
    return np.sin(2 * np.pi * 8 * t) + 0.5 * np.sin(2 * np.pi * 16 * t + 0.7)


def _chirp(t: Signal) -> Signal:
    return np.asarray(np.sin(2 * np.pi * (2 * t + 18 * t**3)))


def _spectro(t: Signal) -> Signal:
    f = np.zeros_like(t)
    for place, height, width in _LINES:
        f += height / (1 + ((t - place) / width) ** 2)
    return np.asarray(f - f.mean())


def _twotone(t: Signal) -> Signal:
    ramp = np.clip(20 * (t - 0.5), 0.0, 1.0)
    return np.sin(2 * np.pi * 3 * t) + 0.6 * ramp * np.sin(2 * np.pi * 40 * t)


_SHAPES = {
    "sines": (_sines, STD5),
    "doppler": (_doppler, STD5),
    "heavisine": (_heavisine, STD5),
    "bumps": (_bumps, STD5),
    "blocks": (_blocks, STD5),
    "periodic": (_periodic, STD5),
    "chirp": (_chirp, 0.0),
    "doppler6": (_doppler, STD6),
    "spectro": (_spectro, STD6),
    "twotone": (_twotone, 0.0),
}


def clean(name: str, n: int = 1024) -> Signal:
    """The signal ``name`` at n samples, scaled as the figures of its chapter are.

    Raises:
        BadInput: the name is none of ``CHAPTER5`` and ``CHAPTER6``, or n < 2.
    """
    if name not in _SHAPES:
        raise BadInput(f"'{name}' is none of the test signals: {', '.join(_SHAPES)}")
    if n < 2:
        raise BadInput(f"a test signal has at least 2 samples, not {n}")
    shape, std = _SHAPES[name]
    f = shape(np.arange(n) / n)
    return np.asarray(f * (std / f.std()) if std else f)


def impulsive_noise(
    f: Signal, rho: float, seed: int, share: float = 0.03, snr_before: float = SNR_BEFORE
) -> Signal:
    """Noise for ``f``: white Gaussian plus impulses, of the SNR ``snr_before`` [dB] exactly.

    Each sample is hit with the probability ``share`` by an impulse of either sign and the size
    U[0.7, 1.3]; the parts, of unit power each, are mixed sqrt(1 - rho) : sqrt(rho).

    Args:
        f: the clean signal.
        rho: share of the impulses of the noise power, 0 .. 1. The thesis states none.
        seed: of numpy's default_rng.
        share: probability of an impulse at a sample. The thesis states none.
        snr_before: 10 log10(var(f) / mean(noise^2)) [dB].
    """
    rng = np.random.default_rng(seed)
    white = rng.standard_normal(len(f))
    hit = rng.random(len(f)) < share
    sign = rng.choice(np.array([-1.0, 1.0]), len(f))
    impulses = hit * sign * rng.uniform(0.7, 1.3, len(f))
    noise = math.sqrt(1 - rho) * _unit_power(white) + math.sqrt(rho) * _unit_power(impulses)
    return np.asarray(_unit_power(noise) * (f.std() * 10 ** (-snr_before / 20)))


def white_noise(n: int, sigma: float, seed: int) -> Signal:
    """White noise: n samples of N(0, sigma^2), seed of numpy's default_rng."""
    return sigma * np.random.default_rng(seed).standard_normal(n)


def spiky_noise(n: int, sigma: float, seed: int, share: float = 0.02) -> Signal:
    """White noise of N(0, sigma^2), and in a ``share`` of the samples impulses of 1 to 3 units."""
    rng = np.random.default_rng(seed)
    noise = sigma * rng.standard_normal(n)
    hit = rng.random(n) < share
    sign = rng.choice(np.array([-1.0, 1.0]), n)
    return np.asarray(noise + hit * sign * rng.uniform(1.0, 3.0, n))


def snr_db(f: Signal, estimate: Signal) -> float:
    """10 log10(var(f) / mean((estimate - f)^2)) [dB]; infinite for a perfect estimate."""
    error = float(np.mean((estimate - f) ** 2))
    if error == 0.0:
        return math.inf
    return 10 * math.log10(float(np.var(f)) / error) if np.var(f) > 0 else -math.inf


def rmse(f: Signal, estimate: Signal) -> float:
    """Root of the mean squared error, in the unit of ``f``."""
    return math.sqrt(float(np.mean((estimate - f) ** 2)))


def _unit_power(x: Signal) -> Signal:
    power = float(np.mean(x**2))
    return x / math.sqrt(power) if power > 0 else x
