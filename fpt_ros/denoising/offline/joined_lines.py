"""Regression lines that join at given samples (thesis section 6.2.2).

Each section between two knots gets a line y = m_i x + b_i; all are found together from

    sum over sections, sum over its samples of (m_i x + b_i - y)^2 -> min      (6.12)
    m_i x_k + b_i = m_{i+1} x_k + b_{i+1} at each inner knot x_k               (6.13)

Joined lines are a piecewise linear function, so the unknowns can be its values at the knots, in the
basis of hat functions: the constraints are gone and the normal equations are tridiagonal. The
solution is that of the Lagrange multipliers. A knot's own sample belongs to the section on its
left.

Misprints corrected: the second sum of (6.12) runs over [x_2, x_3], and (6.13) is an equation: the
print has a minus in place of its sign.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solveh_banded

from fpt_ros.denoising.offline import Signal


def joined_lines(y: Signal, knots: NDArray[np.int64]) -> Signal:
    """The joined lines of least squares through ``y``, at all of its samples, shape (n,).

    Args:
        y: samples, shape (n,), n >= 2.
        knots: ascending sample numbers; the first and the last sample are made knots too.
    """
    n = len(y)
    at = np.unique(np.concatenate(([0], knots, [n - 1])))
    x = np.arange(n)
    section = np.clip(np.searchsorted(at, x, side="left") - 1, 0, len(at) - 2)
    right = (x - at[section]) / (at[section + 1] - at[section])  # hat of the knot on the right
    left = 1.0 - right
    size = len(at)
    banded = np.zeros((2, size))
    banded[1] = np.bincount(section, left * left, size)
    banded[1] += np.bincount(section + 1, right * right, size)
    banded[0, 1:] = np.bincount(section, left * right, size)[:-1]
    moments = np.bincount(section, left * y, size) + np.bincount(section + 1, right * y, size)
    values = solveh_banded(banded, moments)
    return np.asarray(left * values[section] + right * values[section + 1])
