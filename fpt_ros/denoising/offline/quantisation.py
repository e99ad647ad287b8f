"""The step of a converter or of a printed table, found from the record itself."""

import math

import numpy as np

from fpt_ros.denoising.offline import Mask, Signal

CLOSE = 1e-3
"""Distances of levels are whole numbers of steps to this accuracy."""
FEWEST = 1.5
"""Samples per level on average: a record that never comes back to a level is not rounded."""
BELOW = 1.25
TRUST = 1.2
"""Of the level of rounding: some noise was there before it."""
PARTS = 6
"""The least distance may be so many steps."""


def least_step(y: Signal, present: Mask) -> float:
    """LSB, unit of y: the greatest step of which all distances of levels are multiples; 0: none."""
    levels = np.unique(y[present])
    size = float(np.max(np.abs(levels)))
    distances = np.diff(levels)
    # levels that differ by rounding are one
    distances = distances[distances > 1e-9 * size]
    if len(distances) < 2 or len(distances) * FEWEST > present.sum():
        return 0.0
    least = float(distances.min())
    for parts in range(1, PARTS + 1):
        counts = distances / (least / parts)
        whole = np.rint(counts)
        near = np.abs(counts - whole) < CLOSE * np.maximum(1.0, np.minimum(whole, 20.0))
        if near.all():
            step = float(distances.sum() / whole.sum())
            return step if _real(len(distances), float(whole.sum())) else 0.0
    return 0.0


def _real(count: int, span: float) -> bool:
    """Whether so many distances could not be multiples by chance."""
    return span < 1.0 / CLOSE * count or count > 20


def trusted(sigma: float, step: float) -> float:
    """The level of noise of a record with the step ``step``, if ``sigma`` is what it looks like.

    Below about a step, a level mistakes the roundings of a fast signal for noise: then only that of
    rounding is sure.
    """
    return TRUST * floor(step) if step > 0.0 and sigma < BELOW * step else sigma


def floor(step: float) -> float:
    """Standard deviation of rounding to a multiple of ``step``."""
    return step / math.sqrt(12.0)
