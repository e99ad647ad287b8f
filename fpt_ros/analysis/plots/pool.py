"""The numbers of curves as a page holds them: each once, and no more than it can carry."""

from dataclasses import dataclass, field

import numpy as np
from bokeh.models import ColumnDataSource
from numpy.typing import NDArray

from fpt_ros.analysis.decimate import keep
from fpt_ros.analysis.panels import Curve
from fpt_ros.runs.run import Array

BUDGET = 15_000_000
"""Bytes of all numbers; the page writes them in base64, which makes four of three."""

LARGEST = float(np.finfo(np.float32).max)


@dataclass
class _Group:
    """Signals at common times."""

    time: Array
    signals: dict[bytes, Array] = field(default_factory=dict)
    source: ColumnDataSource | None = None

    @property
    def size(self) -> int:
        """Bytes: times are doubles, numbers are single."""
        return len(self.time) * (8 + 4 * len(self.signals))

    def name(self, signal: Array) -> str:
        """Column of a signal."""
        return f"y{list(self.signals).index(signal.tobytes())}"


class Pool:
    """Takes curves; equal times and equal signals are kept once."""

    def __init__(self) -> None:
        self._groups: dict[bytes, _Group] = {}

    def add(self, curve: Curve) -> None:
        """Take a curve over time, or a path with its time."""
        group = self._groups.setdefault(_time(curve).tobytes(), _Group(_time(curve)))
        for signal in _signals(curve):
            group.signals[signal.tobytes()] = signal

    def finish(self) -> None:
        """Make the sources; curves lose points, but no peak, where all are too many."""
        whole = sum(group.size for group in self._groups.values())
        for group in self._groups.values():
            signals = list(group.signals.values())
            limit = int(len(group.time) * min(1.0, BUDGET / max(whole, 1)))
            kept = keep(*signals, limit=max(limit, 1))
            data = {f"y{at}": _single(signal[kept]) for at, signal in enumerate(signals)}
            group.source = ColumnDataSource({"time": group.time[kept], **data})

    def of(self, curve: Curve) -> tuple[ColumnDataSource, list[str]]:
        """Source of a curve, and its columns: one over ``time``, two of a path."""
        group = self._groups[_time(curve).tobytes()]
        assert group.source is not None
        return group.source, [group.name(signal) for signal in _signals(curve)]


def _time(curve: Curve) -> Array:
    return curve.x if curve.time is None else curve.time


def _signals(curve: Curve) -> tuple[Array, ...]:
    return (curve.y,) if curve.time is None else (curve.x, curve.y)


def _single(values: Array) -> NDArray[np.float32]:
    """Seven digits are enough to look at; what is beyond them counts as missing."""
    known = np.abs(values) < LARGEST
    return np.where(known, values, np.nan).astype(np.float32)
