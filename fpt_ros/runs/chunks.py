"""A run chunk by chunk: who takes it, and how it is cut into the same pieces whoever gives it."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Protocol

import numpy as np

from fpt_ros.messages.frames import Frame
from fpt_ros.messages.topics import DESIRED, LOOP_TOPICS, Topic
from fpt_ros.runs.run import Series

CHUNK = 8192
"""Cycles in a piece, and whose messages the engine holds at a time, between two looks at Ctrl-C."""

MILLISECOND = 1_000_000
"""Cycle time [ns] of a run that does not say its own."""

Chunk = Mapping[str, Series]
"""All messages of some cycles in a row, by topic name."""


class Consumer(Protocol):
    """Takes the cycles of a run in their order, as many at a time as there are."""

    def take(self, chunk: Chunk) -> None:
        """Take the next cycles; the arrays are valid during the call only."""
        ...


class Pieces:
    """Cuts a run into pieces of CHUNK cycles, counted from its first stamp.

    Sums that are taken piece by piece are then the same to the last bit, whatever the sizes of the
    chunks that come, and whether messages are missing or not. At most one piece is kept.

    Args:
        cycle_time: of the run [ns].
        use: is given every piece that has a message in it, in their order.
    """

    def __init__(self, cycle_time: int | None, use: Callable[[Chunk], None]) -> None:
        self._cycle_time = cycle_time or MILLISECOND
        self._use = use
        self._origin: int | None = None
        self._number = -1
        self._waiting: dict[str, list[Series]] = {}

    def take(self, chunk: Chunk) -> None:
        """Cut a chunk, whose stamps are ascending in each topic."""
        given = {name: series for name, series in chunk.items() if len(series.stamps)}
        if not given:
            return
        if self._origin is None:
            self._origin = min(int(series.stamps[0]) for series in given.values())
        at = dict.fromkeys(given, 0)
        while given:
            first = min(int(series.stamps[at[name]]) for name, series in given.items())
            number = (first - self._origin) // (CHUNK * self._cycle_time)
            end = self._origin + (number + 1) * CHUNK * self._cycle_time
            piece = {}
            for name, series in list(given.items()):
                stop = len(series.stamps)
                if series.stamps[-1] >= end:
                    stop = int(np.searchsorted(series.stamps, end))
                if stop > at[name]:
                    piece[name] = rows(series, at[name], stop)
                at[name] = stop
                if stop == len(series.stamps):
                    del given[name]
            self._add(number, end, piece)
        # what is left must outlive the arrays that it came in
        self._waiting = {
            name: [series.copy() for series in parts] for name, parts in self._waiting.items()
        }

    def _add(self, number: int, end: int, piece: Chunk) -> None:
        if number != self._number:
            self.finish()
            self._number = number
        for name, series in piece.items():
            self._waiting.setdefault(name, []).append(series)
        if all(end - int(series.stamps[-1]) <= self._cycle_time for series in piece.values()):
            self.finish()

    def finish(self) -> None:
        """Use what is left of the last piece, which may be short."""
        if self._waiting:
            piece = {name: joined(parts) for name, parts in self._waiting.items()}
            self._waiting = {}
            self._use(piece)


def rows(series: Series, first: int, end: int) -> Series:
    """Some messages of a topic, as views."""
    vectors = {name: matrix[first:end] for name, matrix in series.vectors.items()}
    return Series(series.stamps[first:end], series.names, vectors)


def joined(parts: Sequence[Series]) -> Series:
    """Series behind each other, over the names of all; NaN where one lacks the column."""
    if len(parts) == 1:
        return parts[0]
    names = tuple(dict.fromkeys(name for part in parts for name in part.names))
    vectors = {
        key: np.concatenate([aligned(part, key, names) for part in parts])
        for key in parts[0].vectors
    }
    return Series(np.concatenate([part.stamps for part in parts]), names, vectors)


def aligned(series: Series, vector: str, names: tuple[str, ...]) -> np.ndarray:
    """(N, m) numbers of a vector over other names; NaN where the series lacks one."""
    if series.names == names:
        return series.vectors[vector]
    wide = np.full((len(series.stamps), len(names)), np.nan)
    for column, name in enumerate(names):
        if name in series.names:
            wide[:, column] = series.column(vector, name)
    return wide


def ordered(topics: Chunk) -> Chunk:
    """Topics with ascending stamps, as those of every run of this package are already."""
    result = {}
    for name, series in topics.items():
        if bool((series.stamps[1:] < series.stamps[:-1]).any()):
            order = np.argsort(series.stamps, kind="stable")
            vectors = {key: matrix[order] for key, matrix in series.vectors.items()}
            series = Series(series.stamps[order], series.names, vectors)
        result[name] = series
    return result


def frames(chunk: Chunk, sharing: bool = True) -> Iterator[tuple[Topic, Frame]]:
    """The messages of a chunk in the order of events.

    Args:
        chunk: what the engine gives: each topic in it has a message in every cycle.
        sharing: coordinates may take turns: ``desired`` names those that have a response.
    """
    shown = [topic for topic in LOOP_TOPICS if topic.name in chunk]
    stamps = [chunk[topic.name].stamps.tolist() for topic in shown]
    numbers = [
        list(zip(*(m.tolist() for m in chunk[topic.name].vectors.values()), strict=True))
        for topic in shown
    ]
    for cycle in range(max(map(len, stamps), default=0)):
        for topic, times, vectors in zip(shown, stamps, numbers, strict=True):
            names, each = chunk[topic.name].names, vectors[cycle]
            if sharing and topic is DESIRED and any(x != x for x in each[2]):
                turn = [at for at, response in enumerate(each[2]) if response == response]
                names = tuple(names[at] for at in turn)
                each = tuple([vector[at] for at in turn] for vector in each)
            yield topic, topic.frame(times[cycle], names, *each)
