"""The last cycles of one loop, from the pieces that its nodes tell."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from fpt_ros.bags import definitions
from fpt_ros.bags.block import Kind, Source
from fpt_ros.bags.layout import Layout, Malformed, layout
from fpt_ros.bags.loop_series import series
from fpt_ros.bags.numbers import Part, Reading
from fpt_ros.messages.frames import SECOND, Names
from fpt_ros.messages.topics import LOOP_TOPICS, Topic
from fpt_ros.runs.run import Array, Series
from fpt_ros.watch.ring import Ring

CYCLES = 20_000
"""Cycles of each topic that are kept."""

WALL_CLOCK = 10**15
"""Stamps [ns] from which on they are of a wall clock, and not counted from the run's begin."""

NOTHING: Array = np.empty(0)


class Track:
    """The last messages of one topic.

    Attributes:
        names: of the numbers of each vector.
        ring: stamps, and vector after vector.
    """

    def __init__(self, topic: Topic, names: Names = ()) -> None:
        self.names = names
        self.ring = Ring(len(topic.vectors) * len(names), CYCLES)
        self._topic = topic
        self._layouts: dict[int, Layout] = {}

    @property
    def last(self) -> int:
        """The newest stamp [ns]; -1: there is none."""
        stamps = self.ring.stamps
        return int(stamps[-1]) if len(stamps) else -1

    def read(self, messages: list[bytes]) -> Series:
        """Messages as numbers; those that are none of the topic's type are left out."""
        parts, places = [], np.arange(len(messages))
        sizes = np.array([len(each) for each in messages])
        for size in np.unique(sizes).tolist():
            at = places[sizes == size]
            rows = np.frombuffer(b"".join([messages[i] for i in at]), np.uint8)
            rows = rows.reshape(len(at), size)
            while len(at):
                known = self._layouts.get(size)
                fits = known.fits(rows) if known is not None else np.zeros(len(at), dtype=bool)
                if known is not None and fits.any():
                    numbers = {leaf.path: known.numbers(rows[fits], leaf) for leaf in known.leaves}
                    parts.append(Part(known, at[fits], numbers))
                    rows, at = rows[~fits], at[~fits]
                    continue
                try:
                    self._layouts[size] = _layout(self._topic, rows[0].tobytes())
                except Malformed:
                    rows, at = rows[1:], at[1:]
        stamps = np.zeros(len(messages), dtype=np.int64)
        return series(self._topic, Reading(stamps, parts))[0]

    def extend(self, new: Series) -> None:
        """Add messages; names that were not known get columns of their own."""
        known = tuple(dict.fromkeys((*self.names, *new.names)))
        if known != self.names:
            wider = Track(self._topic, known)
            wider.ring.extend(self.ring.stamps, self._rows(known, self.names, self._old()))
            self.names, self.ring = known, wider.ring
        self.ring.extend(new.stamps, self._rows(known, new.names, new.vectors))

    def column(self, vector: str, name: str) -> Array:
        """(n,) numbers; empty where there are none of this name."""
        if name not in self.names:
            return NOTHING
        at = self._topic.vectors.index(vector) * len(self.names) + self.names.index(name)
        return self.ring.rows[:, at]

    def _old(self) -> dict[str, Array]:
        width = len(self.names)
        rows = self.ring.rows
        return {
            vector: rows[:, i * width : (i + 1) * width]
            for i, vector in enumerate(self._topic.vectors)
        }

    def _rows(self, known: Names, names: Names, vectors: Any) -> Array:
        places = [known.index(name) for name in names]
        count = len(next(iter(vectors.values())))
        rows = np.full((count, len(self._topic.vectors), len(known)), np.nan)
        for i, vector in enumerate(self._topic.vectors):
            rows[:, i, places] = vectors[vector]
        return rows.reshape(count, len(self._topic.vectors) * len(known))


class Heard:
    """The last cycles of a loop.

    Attributes:
        tracks: by topic.
        runs: how many runs have been heard: stamps begin again.
    """

    def __init__(self) -> None:
        self.runs = 1
        self.tracks = {topic.name: Track(topic) for topic in LOOP_TOPICS}
        self._origin: int | None = None

    def take(self, topic: Topic, messages: list[bytes]) -> bool:
        """Messages of a topic, in order; whether any was new."""
        track = self.tracks[topic.name]
        new = track.read(messages)
        if not len(new.stamps) or new.stamps[-1] == track.last:
            return False  # told again: the loop stands still
        if new.stamps[-1] < track.last:
            self._forget()
            track = self.tracks[topic.name]
        later = new.stamps > track.last
        vectors = {key: matrix[later] for key, matrix in new.vectors.items()}
        if self._origin is None:
            self._origin = int(new.stamps[0]) if new.stamps[0] > WALL_CLOCK else 0
        track.extend(Series(new.stamps[later], new.names, vectors))
        return True

    @property
    def last(self) -> int:
        """The newest stamp [ns]; -1: nothing was heard."""
        return max(track.last for track in self.tracks.values())

    @property
    def now(self) -> float:
        """The newest time [s], as of :meth:`seconds`; 0: nothing was heard."""
        return (self.last - (self._origin or 0)) / SECOND if self.last >= 0 else 0.0

    def seconds(self, stamps: NDArray[np.int64]) -> Array:
        """Time [s] from the begin of the run, or from what was heard first of a wall clock."""
        seconds: Array = (stamps - (self._origin or 0)) / SECOND
        return seconds

    def _forget(self) -> None:
        self.tracks = {topic.name: Track(topic) for topic in LOOP_TOPICS}
        self._origin = None
        self.runs += 1


def _layout(topic: Topic, data: bytes) -> Layout:
    return layout(topic.type, definitions.of(Source(topic.name, topic.type), _KIND), data)


_KIND = Kind("cdr", "", b"", {})
