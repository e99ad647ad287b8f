"""Where ``auto`` does not believe its own best model: there the record stays as it is.

A model that does not fit the signal explains the misfit by impulses, and so can win against the
record as it is. But impulses come alone: three in a row, or a fifth of all samples around one
place, are a signal, unless the noise has so heavy a tail that chance makes them.

What a model leaves is noise, or the model is not believed, whatever it is of: one frequency at
a time is none. So a few tones do not win against a chirp, nor stairs against a fast oscillation.
Where little is taken away nothing is asked.

A sample that is rounded, and has no other noise, is within a step of the signal, or an impulse:
that sticks out of a calm neighbourhood. What a model misses else is a jump, or fast oscillation.

Stairs whose steps are those of rounding are of a smooth signal that was rounded.

In a short record noise that would be nearly half of the variance cannot be told from a signal as
rough: whatever is taken away may be the signal.
"""

import math

import numpy as np
from scipy.ndimage import binary_dilation, binary_opening, gaussian_filter1d, median_filter

from fpt_ros.denoising.offline import Mask, Signal
from fpt_ros.denoising.offline.colour import LOUDEST
from fpt_ros.denoising.offline.library import ON_CURVE, SWEEPS, TONES, Judge, Member
from fpt_ros.denoising.offline.mixture import MOST_SHARE
from fpt_ros.denoising.offline.spectral_floor import flatness, level
from fpt_ros.denoising.offline.whiteness import FLAT, is_white

LIKELY = 0.86
"""Probability above which a sample of a run is an impulse."""
CHANCE = 0.01
"""Runs, and densities, that impulses on their own would have in this share of records, are bursts.
A heavy tail is many impulses: of 15 %, three in a row are nothing."""
LEAST_RUN = 3
REACH, WINDOW = 8, 24
"""Samples around a burst; standard deviation of the window of the density of impulses: in a
narrower one, or next to an end, five impulses are dense by chance."""
DENSE, THIN = 0.2, 0.1
"""Density that is a burst, and down to which a burst goes."""
SIGMAS = 4.0
"""Standard deviations above the typical density that is a burst."""
FAR, STICKS_OUT = 1.5, 0.7
"""Steps of rounding that an estimate is from its sample at most, but for an impulse; and the share
of its residual by which an impulse sticks out of both neighbours."""
ONWARDS = 0.75
"""Share of the jumps of stairs that go on the way of the last one, from which on it is a slope."""
LIVELY = 0.25
"""Share of a residual by which the estimate moves from sample to sample, from which on it may be
the signal."""
WHITE = 0.85
"""Least level of what tones leave, in units of its standard deviation, that is white."""
SHORT = 128
NOISY = 0.4
"""Share of the variance above which the noise of a short record is doubted."""


def bursts(impulse: Signal) -> Mask:
    """True where impulses come in bursts, shape (n,).

    Args:
        impulse: probability that a sample is one, shape (n,).
    """
    n = len(impulse)
    density = gaussian_filter1d(impulse, WINDOW, mode="reflect")
    typical = min(float(np.median(density)), MOST_SHARE)
    # a Gaussian window is as wide as 2 sqrt(pi) standard deviations of equal weights
    chance = math.sqrt(typical * (1.0 - typical) / (2.0 * math.sqrt(math.pi) * WINDOW))
    dense = max(DENSE, typical + SIGMAS * chance)
    found = np.zeros(n, dtype=bool)
    if density.max() > dense:
        found = density > max(THIN, 0.5 * (typical + dense))
    share = min(float(np.sum(impulse[~found])) / n, MOST_SHARE)
    run = LEAST_RUN
    while n * share**run > CHANCE:
        run += 1
    runs = binary_opening(impulse > LIKELY, np.ones(run))
    return np.asarray(found | binary_dilation(runs, iterations=REACH))


def no_rounding(y: Signal, estimate: Signal, step: float) -> Mask:
    """True where rounding alone does not explain the residual, and no impulse does, shape (n,).

    Args:
        y: samples rounded to multiples of ``step``, with noise below that.
        estimate: of the signal.
        step: of rounding, unit of y.
    """
    residual = y - estimate
    far = np.abs(residual) > FAR * step
    least = STICKS_OUT * np.abs(residual)
    steps = np.diff(y)
    sign = np.sign(residual)
    left, right = np.zeros(len(y), dtype=bool), np.zeros(len(y), dtype=bool)
    left[1:] = (sign[1:] * steps > least[1:]) | far[:-1]  # far neighbours say nothing
    right[:-1] = (-sign[:-1] * steps > least[:-1]) | far[1:]
    moves = np.abs(np.diff(estimate, append=estimate[-1]))
    calm = median_filter(moves, 2 * REACH + 1, mode="nearest") < LIVELY * np.abs(residual)
    return np.asarray(far & ~(left & right & calm))


def stairs_of_rounding(estimate: Signal, step: float) -> bool:
    """Whether the jumps of a piecewise constant estimate are those of a slope that was rounded.

    Most are of one step of rounding [unit of y], and go on the way that the last one went: a smooth
    signal that is rounded is such stairs, a switch or a walk is not.
    """
    jumps = np.diff(estimate)
    jumps = jumps[np.abs(jumps) > 0.5 * step]
    if len(jumps) < 2 or float(np.median(np.abs(jumps))) >= FAR * step:
        return False
    return float(np.mean(jumps[1:] * jumps[:-1] > 0.0)) > ONWARDS


def _taken(y: Signal, present: Mask, judge: Judge, estimate: Signal) -> float:
    """Share of the variance that is taken away, impulses not counted."""
    residual = y - estimate
    inlier = judge.noise.inlier(residual, present)
    mean = float(np.sum(inlier * residual**2)) / max(float(np.sum(inlier)), 1.0)
    return mean / float(np.var(y[present]))


def leaves_noise(y: Signal, present: Mask, judge: Judge, member: Member) -> bool:
    """Whether the residual is small or, without impulses and at one level, white in each frame."""
    residual = y - member.estimate
    if member.name in (SWEEPS, ON_CURVE) and not is_white(residual / judge.noise.sigma, present):
        return False
    if _taken(y, present, judge, member.estimate) < LOUDEST:
        return True
    noise = judge.noise.inlier(residual, present) * residual / judge.noise.sigma
    if member.name == TONES and level(noise, present) < WHITE * float(np.std(noise[present])):
        return False
    return flatness(noise) > FLAT


def hardly_told(y: Signal, present: Mask, judge: Judge, estimate: Signal) -> bool:
    """Whether what is taken away is too great a part of the record."""
    return _taken(y, present, judge, estimate) > NOISY
