"""The numbers of curves as a page holds them: each once, and no more than it can carry."""

from dataclasses import dataclass, field

import numpy as np
from bokeh.models import ColumnDataSource
from numpy.typing import NDArray

from fpt_ros.analysis.decimate import keep
from fpt_ros.analysis.panel import Curve
from fpt_ros.runs.run import Array

BUDGET = 15_000_000
"""Bytes of all numbers; the page writes them in base64, which makes four of three."""

TIME, NUMBER = 8, 4
"""Bytes of a time and of a number, which is single: seven digits are enough to look at."""

LARGEST = float(np.finfo(np.float32).max)

Place = tuple[ColumnDataSource, list[str]]
"""Where a curve is: its source, and its columns there, one over ``time``, two of a path."""


@dataclass
class _Group:
    """Signals at common times."""

    time: Array
    signals: dict[bytes, Array] = field(default_factory=dict)

    def source(self, limit: int) -> ColumnDataSource:
        """The signals as columns y0, y1, ... of about so many points, peaks among them."""
        signals = list(self.signals.values())
        kept = keep(*signals, limit=limit)
        data = {f"y{at}": _single(signal[kept]) for at, signal in enumerate(signals)}
        return ColumnDataSource({"time": self.time[kept], **data})


class Pool:
    """Takes curves over time, and paths with their time, and gives them places.

    Equal times and equal signals are kept once while all fits into the budget. Otherwise each
    curve has points of its own: so they are fewest for the peaks that they keep.
    """

    def __init__(self, budget: int = BUDGET) -> None:
        self._budget = budget
        self._curves: dict[tuple[bytes, ...], Curve] = {}
        self._places: dict[tuple[bytes, ...], Place] = {}

    def add(self, curve: Curve) -> None:
        """Take a curve."""
        self._curves[_key(curve)] = curve

    def finish(self) -> None:
        """Give all curves their places."""
        groups: dict[bytes, _Group] = {}
        for (time, *keys), curve in self._curves.items():
            group = groups.setdefault(time, _Group(_time(curve)))
            group.signals.update(zip(keys, _signals(curve), strict=True))
        size = sum(len(g.time) * (TIME + NUMBER * len(g.signals)) for g in groups.values())
        if size <= self._budget:
            sources = {time: group.source(len(group.time)) for time, group in groups.items()}
            for time, *keys in self._curves:
                columns = [f"y{list(groups[time].signals).index(key)}" for key in keys]
                self._places[time, *keys] = sources[time], columns
            return
        points = self._budget // sum(TIME + NUMBER * (len(key) - 1) for key in self._curves)
        for key, curve in self._curves.items():
            group = _Group(_time(curve), dict(zip(key[1:], _signals(curve), strict=True)))
            columns = [f"y{at}" for at in range(len(group.signals))]
            self._places[key] = group.source(points), columns

    def of(self, curve: Curve) -> Place:
        """The place of a curve that was added."""
        return self._places[_key(curve)]


def _key(curve: Curve) -> tuple[bytes, ...]:
    return _time(curve).tobytes(), *(signal.tobytes() for signal in _signals(curve))


def _time(curve: Curve) -> Array:
    return curve.x if curve.time is None else curve.time


def _signals(curve: Curve) -> tuple[Array, ...]:
    return (curve.y,) if curve.time is None else (curve.x, curve.y)


def _single(values: Array) -> NDArray[np.float32]:
    """What is too large for single precision counts as missing."""
    known = np.abs(values) < LARGEST
    return np.where(known, values, np.nan).astype(np.float32)
