"""Where ``auto`` does not believe its own best model: there the record stays as it is.

A model that does not fit the signal explains the misfit by impulses, and so can win against the
record as it is. But impulses come alone: of 208 records with impulses, or with tails as heavy,
none had three in a row or a fifth of all samples around one place, and all models that had did
harm.

In a short record noise that would be nearly half of the variance cannot be told from a signal as
rough: whatever is taken away may be the signal.
"""

import numpy as np
from scipy.ndimage import binary_dilation, gaussian_filter1d

from fpt_ros.denoising.offline import Mask, Signal
from fpt_ros.denoising.offline.library import Judge

IN_A_ROW = 2.6
"""Sum of the probabilities of three impulses in a row that is a burst."""
REACH = 8
"""Samples around a burst, and standard deviation of the window of the density of impulses."""
DENSE, THIN = 0.2, 0.1
"""Density that is a burst, and down to which a burst goes."""
SHORT = 128
NOISY = 0.4
"""Share of the variance above which the noise of a short record is doubted."""


def bursts(impulse: Signal) -> Mask:
    """True where impulses come in bursts, shape (n,).

    Args:
        impulse: probability that a sample is one, shape (n,).
    """
    found = np.zeros(len(impulse), dtype=bool)
    found[1:-1] = impulse[:-2] + impulse[1:-1] + impulse[2:] > IN_A_ROW
    if found.any():
        found = binary_dilation(found, iterations=REACH)
    density = gaussian_filter1d(impulse, REACH, mode="reflect")
    if density.max() > DENSE:
        found |= density > THIN
    return found


def hardly_told(y: Signal, present: Mask, judge: Judge, estimate: Signal) -> bool:
    """Whether what is taken away, impulses not counted, is too great a part of the record."""
    residual = y - estimate
    inlier = judge.noise.inlier(residual, present)
    taken = float(np.sum(inlier * residual**2) / max(float(np.sum(inlier)), 1.0))
    return taken > NOISY * float(np.var(y[present]))
