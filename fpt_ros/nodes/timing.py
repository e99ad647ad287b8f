"""When the plant's measurements went out, and how long their commands took."""

from collections import deque
from time import monotonic

from fpt_ros.runs.latency import HISTOGRAM, LARGEST, MISSED, Histogram

REMEMBERED = 1024
"""Cycles whose command may still come and be timed."""


class Timing:
    """Of the plant's node.

    Attributes:
        timed: stamp of the newest command that was timed [ns].
        latest: monotonic time of the newest measurement [s], 0 before the first.
        misses: deadlines that were missed.
    """

    def __init__(self) -> None:
        self.timed = -1
        self.latest = 0.0
        self.misses = 0
        self._sent_at: deque[float] = deque(maxlen=REMEMBERED)
        self._latencies: list[float] = []
        self._histogram = Histogram()

    def sent(self) -> None:
        """A measurement goes out."""
        self.latest = monotonic()
        self._sent_at.append(self.latest)

    def heard(self, stamp: int, late: int) -> None:
        """Count the latency of the command of a cycle that is ``late`` cycles ago."""
        if stamp <= self.timed or not 0 <= late < len(self._sent_at):
            return  # timed, of another run, or too late to be known
        self.timed = stamp
        latency = monotonic() - self._sent_at[-1 - late]
        self._latencies.append(latency)
        self._histogram.add(latency)

    def report(self, realtime: bool) -> dict[str, object]:
        """Misses, and latencies [ms]: of those since the last report, and how all are spread."""
        values: dict[str, object] = {}
        if realtime:
            values[MISSED] = self.misses
            values[LARGEST] = f"{1e3 * self._histogram.largest:.3f}"
            values[HISTOGRAM] = self._histogram.text()
        if self._latencies:
            ordered, self._latencies = sorted(self._latencies), []
            values["latency median [ms]"] = f"{1e3 * ordered[len(ordered) // 2]:.3f}"
            values["latency p99 [ms]"] = f"{1e3 * ordered[int(0.99 * len(ordered))]:.3f}"
            values["latency max [ms]"] = f"{1e3 * ordered[-1]:.3f}"
        return values
