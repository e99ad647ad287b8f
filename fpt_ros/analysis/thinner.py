"""Curves of any length in constant memory: a few thousand points, peaks among them."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fpt_ros.runs.run import Array

CAPACITY = 32_768
"""Points that are kept at most, unless more are asked for; up to so many nothing is dropped."""

GOLDEN = np.uint64(0x9E3779B97F4A7C15)
"""Odd, near 2^64 over the golden ratio: multiples of it, modulo 2^64, are in no order."""


@dataclass(frozen=True)
class Window:
    """A stretch of time [s]."""

    first: float
    last: float

    def inside(self, time: Array) -> NDArray[np.bool_]:
        """(N,) whether times are in it."""
        return (time >= self.first) & (time <= self.last)

    def covers(self, other: "Window") -> bool:
        """Whether the other is inside this one."""
        return self.first <= other.first and other.last <= self.last


@dataclass(frozen=True)
class Thinned:
    """Points of signals at common times.

    Attributes:
        time: (M,) [s], rising.
        signals: (M,) each.
        typical: (M,) points that are no extremes but picked at random: percentiles are of these.
        whole: no point has been dropped.
    """

    time: Array
    signals: tuple[Array, ...]
    typical: NDArray[np.bool_]
    whole: bool


class Thinner:
    """Takes signals piece by piece; keeps of each bucket of points the extremes of every signal.

    A bucket is a number of points in a row, a power of two that grows with the number of points so
    that all buckets together fit into the capacity. Of each bucket there are also its first gap
    (NaN) and a point picked at random, and the very first and last point are kept. What is kept
    does not depend on the sizes of the pieces.

    Args:
        signals: number of signals.
        near: where every point is kept as well.
        capacity: points that are kept at most.
    """

    def __init__(self, signals: int, near: Window | None = None, capacity: int = CAPACITY) -> None:
        self._capacity = capacity
        self._buckets = capacity // (2 * signals + 2)
        self._parts: list[Array] = []
        self._held = 0
        self._near: list[Array] = []
        self._window = near
        self._width = signals + 2
        self.count = 0

    def take(self, time: Array, *signals: Array) -> None:
        """Take the next points, (N,) each."""
        if not len(time):
            return
        table = np.empty((len(time), self._width))
        table[:, 0] = np.arange(self.count, self.count + len(time))
        for column, values in enumerate((time, *signals), 1):
            table[:, column] = values
        self._parts.append(table)
        self._held += len(time)
        self.count += len(time)
        window = self._window
        if window is not None and time[-1] >= window.first and time[0] <= window.last:
            self._near.append(table[window.inside(time)])
        if self._held > 2 * self._capacity:
            self._compact()

    def _compact(self) -> Array:
        table = np.concatenate(self._parts) if self._parts else np.empty((0, self._width))
        if self.count > self._capacity:
            table = table[_chosen(table, self._bucket())]
        self._parts, self._held = [table], len(table)
        return table

    def _bucket(self) -> int:
        """Points in a bucket."""
        width = 1
        while -(-self.count // width) > self._buckets:
            width *= 2
        return width

    def result(self) -> Thinned:
        """The points so far."""
        table = self._compact()
        whole = self.count <= self._capacity
        typical = np.full(len(table), True)
        if not whole:
            typical[:] = False
            typical[_picked(table[:, 0].astype(np.int64), self._bucket())] = True
        return _thinned(table, typical, whole)

    def near(self) -> Thinned:
        """All points so far in the window."""
        table = np.concatenate(self._near) if self._near else np.empty((0, self._width))
        return _thinned(table, np.full(len(table), True), True)


def _thinned(table: Array, typical: NDArray[np.bool_], whole: bool) -> Thinned:
    columns = np.ascontiguousarray(table.T)
    return Thinned(columns[1], tuple(columns[2:]), typical, whole)


def _chosen(table: Array, width: int) -> NDArray[np.bool_]:
    """(M,) which rows to keep of buckets that have so many points."""
    index = table[:, 0].astype(np.int64)
    bucket = index // width
    starts = np.flatnonzero(np.diff(bucket, prepend=-1))
    counts = np.diff(starts, append=len(bucket))
    chosen = np.full(len(bucket), False)
    chosen[[0, -1]] = True
    chosen[_picked(index, width)] = True
    gap = np.full(len(bucket), False)
    for column in range(2, table.shape[1]):
        signal = np.ascontiguousarray(table[:, column])
        missing = np.isnan(signal)
        gap |= missing
        for fill, extreme in ((np.inf, np.minimum), (-np.inf, np.maximum)):
            known = np.where(missing, fill, signal) if missing.any() else signal
            best = np.repeat(extreme.reduceat(known, starts), counts)
            chosen[_firsts(bucket, known == best)] = True
    chosen[_firsts(bucket, gap)] = True
    return chosen


def _firsts(bucket: NDArray[np.int64], there: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Of each bucket the first row that is there."""
    at = np.flatnonzero(there)
    first: NDArray[np.intp] = at[np.diff(bucket[at], prepend=-1) != 0]
    return first


def _picked(index: NDArray[np.int64], width: int) -> NDArray[np.intp]:
    """Of each bucket one row at random, the same in whatever pieces it comes."""
    bucket = index // width
    dice = index.astype(np.uint64) * GOLDEN
    starts = np.flatnonzero(np.diff(bucket, prepend=-1))
    counts = np.diff(starts, append=len(bucket))
    return np.flatnonzero(dice == np.repeat(np.maximum.reduceat(dice, starts), counts))
