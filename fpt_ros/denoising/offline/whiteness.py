"""Whether a residual is white noise, of whatever distribution."""

import numpy as np

from fpt_ros.denoising.offline import Mask, Signal
from fpt_ros.denoising.offline.spectral_floor import flatness

CLIP = 3.0
"""Standard deviations that an impulse counts at most."""
FLAT = 0.475
"""Least flatness of white noise in a frame: it is 0.58 +- 0.02."""
LAGS, ALIKE = 20, 60.0
"""Lags, and n times the greatest sum of their squared correlations: of white noise 20 +- 6."""


def is_white(residual: Signal, present: Mask) -> bool:
    """Whether neighbours are not alike, and no frame has few frequencies.

    The first is the sum of Box and Pierce (J. Am. Stat. Assoc. 65, 1970); what it does not see, as
    it is over the whole record, is a sweep over the whole band.

    Args:
        residual: in units of the noise's standard deviation, shape (n,).
        present: False where a sample is missing.
    """
    clipped = np.clip(residual[present], -CLIP, CLIP)
    x = clipped - clipped.mean()
    power = float(x @ x)
    alike = sum(float(x[lag:] @ x[:-lag]) ** 2 for lag in range(1, LAGS + 1))
    return len(x) * alike <= ALIKE * power**2 and flatness(x) >= FLAT
