"""The penalty of the Whittaker smoother (discrete smoothing spline) of :mod:`healing`."""

import numpy as np

from fpt_ros.denoising.offline import Signal


def penalty_bands(n: int, order: int) -> Signal:
    """Upper bands of D'D, shape (order + 1, n), as LAPACK stores them: the diagonal is last."""
    taps = np.array([1.0])
    for _ in range(order):
        taps = np.convolve(taps, [1.0, -1.0])
    bands = np.zeros((order + 1, n))
    for shift in range(order + 1):
        for k in range(order + 1 - shift):
            # row r of D holds taps[k] at column r + k; n - order rows
            bands[order - shift, shift + k : shift + k + n - order] += taps[k] * taps[k + shift]
    return bands
