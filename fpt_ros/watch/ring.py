"""The last rows of a table that grows, in constant memory and as one piece."""

import numpy as np
from numpy.typing import NDArray

from fpt_ros.runs.run import Array


class Ring:
    """Rows of numbers with their stamps.

    Attributes:
        first: how many rows have come before the oldest that is kept.
    """

    def __init__(self, width: int, capacity: int) -> None:
        self._stamps = np.empty(2 * capacity, dtype=np.int64)
        self._rows = np.empty((2 * capacity, width))
        self._capacity = capacity
        self._start = self._end = self.first = 0

    @property
    def stamps(self) -> NDArray[np.int64]:
        """(n,) [ns], rising."""
        return self._stamps[self._start : self._end]

    @property
    def rows(self) -> Array:
        """(n, width)."""
        return self._rows[self._start : self._end]

    def extend(self, stamps: NDArray[np.int64], rows: Array) -> None:
        """Add rows at the end; the oldest go."""
        stamps, rows = stamps[-self._capacity :], rows[-self._capacity :]
        count = len(stamps)
        if self._end + count > len(self._stamps):
            kept, old = self._end - self._start, slice(self._start, self._end)
            self._stamps[:kept], self._rows[:kept] = (
                self._stamps[old].copy(),
                self._rows[old].copy(),
            )
            self._start, self._end = 0, kept
        self._stamps[self._end : self._end + count] = stamps
        self._rows[self._end : self._end + count] = rows
        self._end += count
        beyond = max(0, self._end - self._start - self._capacity)
        self._start += beyond
        self.first += beyond
