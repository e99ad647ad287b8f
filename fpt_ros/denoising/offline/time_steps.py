"""Steps of time between samples: equal, or as they are."""

import numpy as np
from numpy.typing import ArrayLike

from fpt_ros.denoising.offline import Signal
from fpt_ros.errors import BadInput

JITTER = 0.02
"""Steps within this share of their mean are equal: clocks round, and methods cannot tell."""


def steps_of(t: ArrayLike | None, dt: float, n: int) -> tuple[Signal, float]:
    """Steps before each sample in units of their mean, shape (n,), ones if equal; and the mean.

    Raises:
        BadInput: times that are no numbers, as many as samples, ascending; a step that is not
            above 0.
    """
    if t is None:
        if not (np.isfinite(dt) and dt > 0.0):
            raise BadInput(f"dt = {dt} is not valid: a step of time is above 0")
        return np.ones(n), float(dt)
    try:
        times = np.asarray(t, dtype=np.float64)
    except (TypeError, ValueError):
        raise BadInput("times have to be numbers") from None
    if times.shape != (n,):
        raise BadInput(f"there are {times.size} times for {n} samples")
    bad = np.flatnonzero(~np.isfinite(times))
    if len(bad):
        raise BadInput(f"{len(bad)} times are missing or infinite, first at index {bad[0]}")
    if n < 2:
        return np.ones(n), 1.0
    steps = np.diff(times)
    bad = np.flatnonzero(steps <= 0.0)
    if len(bad):
        raise BadInput(
            f"times have to ascend: at index {bad[0] + 1} comes {times[bad[0] + 1]:g} after "
            f"{times[bad[0]]:g}: sort the record, and keep one sample of each time"
        )
    mean = float(times[-1] - times[0]) / (n - 1)
    relative = steps / mean
    if np.all(np.abs(relative - 1.0) < JITTER):
        return np.ones(n), mean
    return np.concatenate(([1.0], relative)), mean
