"""Root mean square and largest size of numbers that come piece by piece."""

import math

import numpy as np

from fpt_ros.runs.run import Array

EXTREME = 300
"""Powers of two beyond which the squares of numbers, summed, could overflow or vanish."""


class Size:
    """Size of all numbers that have been added; those that are NaN do not count.

    Squares are summed in units of a power of two where numbers are very large or small, because a
    run that diverges ends in numbers whose squares overflow.
    """

    def __init__(self) -> None:
        self.count = 0
        self._largest = 0.0
        self._sum = 0.0
        self._power = 0

    def add(self, values: Array) -> None:
        """Add (N,) numbers; the sum depends on how they are divided between calls."""
        if not len(values):
            return
        sizes = np.abs(values)
        largest = float(sizes.max())
        if math.isnan(largest):
            sizes = sizes[~np.isnan(sizes)]
            if not len(sizes):
                return
            largest = float(sizes.max())
        self.count += len(sizes)
        self._largest = max(self._largest, largest)
        if largest == 0.0 or math.isinf(self._largest):
            return
        power = math.frexp(largest)[1]
        power = power if abs(power) > EXTREME else 0
        if power:
            sizes = np.ldexp(sizes, -power)
        self._add_squares(float(np.square(sizes, out=sizes).sum()), power)

    def _add_squares(self, squares: float, power: int) -> None:
        """Add a sum of squares in units of ``4 ** power``."""
        if self._sum == 0.0:
            self._sum, self._power = squares, power
            return
        common = max(power, self._power)
        self._sum = _scaled(self._sum, self._power - common) + _scaled(squares, power - common)
        self._power = common

    def merged(self, other: "Size") -> "Size":
        """The size of the numbers of both."""
        both = Size()
        both.count = self.count + other.count
        both._largest = max(self._largest, other._largest)
        for one in (self, other):
            if one._sum:
                both._add_squares(one._sum, one._power)
        return both

    @property
    def largest(self) -> float | None:
        """Largest absolute value; ``None`` where there is none that is finite."""
        return finite(self._largest) if self.count else None

    @property
    def rms(self) -> float | None:
        """Root mean square; ``None`` where there are no numbers, or one that is not finite."""
        if not self.count or math.isinf(self._largest):
            return None
        # halved, because ldexp raises where it rounds up to what is too large
        return finite(2.0 * math.ldexp(0.5 * math.sqrt(self._sum / self.count), self._power))


def _scaled(squares: float, power: int) -> float:
    return math.ldexp(squares, 2 * power) if power else squares


def rms(values: Array) -> float | None:
    """Root mean square of the numbers that are not NaN; ``None`` where there are none."""
    size = Size()
    size.add(values)
    return size.rms


def finite(value: float) -> float | None:
    """The number, or ``None`` where JSON has no word for it."""
    return float(value) if math.isfinite(value) else None
