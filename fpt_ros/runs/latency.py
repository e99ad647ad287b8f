"""The latency from sensor to command in real time: how it is counted, and what the counts say.

The plant's node counts every command into bins of equal ratio and publishes the counts; a recording
holds them, and the report draws them. The bins are defined here alone.
"""

import math
from bisect import bisect_right
from dataclasses import dataclass

from fpt_ros.errors import BadInput

PER_DECADE = 40
"""Bins a decade: a quantile is known to half a bin, 3 percent."""

DECADES = (-5, 1)
"""Powers of ten [s] between which there are bins; what is beyond has one on each side."""

EDGES = tuple(
    math.pow(10.0, k / PER_DECADE)
    for k in range(DECADES[0] * PER_DECADE, DECADES[1] * PER_DECADE + 1)
)
"""Borders between the bins [s], ascending; bin i is below ``EDGES[i]``."""

HISTOGRAM = "latency histogram [ms]"
LARGEST = "latency max so far [ms]"
MISSED = "deadline misses"
CYCLES = "cycles"
"""Keys of the plant simulator on /diagnostics in real time, counted from the start of the run."""

_MS = 1e3


class Histogram:
    """Counts latencies while they come.

    Attributes:
        counts: commands in each bin.
        largest: latency so far [s].
    """

    def __init__(self) -> None:
        self.counts = [0] * (len(EDGES) + 1)
        self.largest = 0.0

    def add(self, latency: float) -> None:
        """Count one latency [s]."""
        self.counts[bisect_right(EDGES, latency)] += 1
        if latency > self.largest:
            self.largest = latency

    def text(self) -> str:
        """``LOWER:COUNT`` of every bin that is not empty, the lower border in [ms]."""
        borders = (0.0, *EDGES)
        return " ".join(
            f"{_MS * low:.4g}:{count}"
            for low, count in zip(borders, self.counts, strict=True)
            if count
        )


@dataclass(frozen=True)
class Latencies:
    """What a run in real time says about itself.

    Attributes:
        counts: commands in each bin of :data:`EDGES`.
        largest: latency [s].
        missed: cycles that ended without their command.
        cycles: that the plant had begun when it said so.
    """

    counts: tuple[int, ...]
    largest: float
    missed: int
    cycles: int

    @property
    def total(self) -> int:
        """Commands that were counted; those that never came are not among them."""
        return sum(self.counts)

    def bounds(self, at: int) -> tuple[float, float]:
        """Lower and upper border of a bin [s]; the outermost are as wide as the others."""
        ratio = EDGES[1] / EDGES[0]
        low = EDGES[at - 1] if at else EDGES[0] / ratio
        return low, EDGES[at] if at < len(EDGES) else low * ratio

    def quantile(self, share: float) -> float:
        """Latency that a share of the commands does not exceed [s], NaN where there are none."""
        wanted, before = share * self.total, 0
        for at, count in enumerate(self.counts):
            if count and before + count >= wanted:
                low, high = self.bounds(at)
                inside = low * math.pow(high / low, (wanted - before) / count)
                return min(inside, self.largest)
            before += count
        return math.nan


def parse(text: str) -> tuple[int, ...]:
    """The counts of :meth:`Histogram.text`.

    Raises:
        BadInput: it is something else.
    """
    counts = [0] * (len(EDGES) + 1)
    for part in text.split():
        low, _, count = part.partition(":")
        try:
            counts[_bin(float(low) / _MS)] += int(count)
        except (ValueError, IndexError, OverflowError):
            raise BadInput(f"'{part}' is no bin of latencies, LOWER:COUNT") from None
    return tuple(counts)


def _bin(low: float) -> int:
    """The bin that begins at a border [s], which may be rounded."""
    if low == 0.0:
        return 0
    at = round((math.log10(low) - DECADES[0]) * PER_DECADE)
    if not 0 <= at < len(EDGES):
        raise IndexError
    return at + 1
