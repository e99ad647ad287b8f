"""A run as arrays: what analysis works on, whether it comes from the engine or from a recording."""

from array import array
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from fpt_ros import __version__
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.laws import Vector
from fpt_ros.messages.frames import SECOND, Frame, Names
from fpt_ros.messages.topics import LOOP_TOPICS, Topic
from fpt_ros.parameters import Value
from fpt_ros.runs.changes import Change
from fpt_ros.runs.latency import Latencies

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Series:
    """All frames of one topic.

    Attributes:
        stamps: (N,) int64, [ns].
        names: of the m columns.
        vectors: name of the frame's vector -> (N, m) numbers, NaN where a frame lacks the column.
    """

    stamps: NDArray[np.int64]
    names: Names
    vectors: Mapping[str, Array]

    @property
    def time(self) -> Array:
        """(N,) times [s]."""
        return self.stamps / SECOND

    def column(self, vector: str, name: str) -> Array:
        """(N,) numbers of one name."""
        return self.vectors[vector][:, self.names.index(name)]

    def copy(self) -> "Series":
        """The same in arrays of its own."""
        vectors = {name: matrix.copy() for name, matrix in self.vectors.items()}
        return Series(self.stamps.copy(), self.names, vectors)

    def without_empty(self, vector: str) -> "Series":
        """The same without the names of which this vector has no number at all."""
        found = np.asarray(~np.isnan(self.vectors[vector]).all(axis=0))
        if found.all():
            return self
        names = tuple(name for name, there in zip(self.names, found, strict=True) if there)
        return Series(
            self.stamps, names, {name: each[:, found] for name, each in self.vectors.items()}
        )


@dataclass(frozen=True)
class Run:
    """Everything about one run.

    Attributes:
        info: experiment, variant, engine, version, complete, reason, ...
        parameters: of every node, complete, as at the start.
        topics: by topic name; one that nobody published is absent.
        latency: from sensor to command, of a run in real time.
        changes: of parameters in flight, in the order in which they came.
    """

    info: Mapping[str, str]
    parameters: Mapping[str, Mapping[str, Value]]
    topics: Mapping[str, Series]
    latency: Latencies | None = None
    changes: tuple[Change, ...] = ()


def describe(experiment: Experiment, engine: str, reason: str) -> dict[str, str]:
    """The ``info`` of a run: ``engine`` is in_process or graph, ``reason`` empty if complete."""
    return {
        "experiment": experiment.name,
        "variant": experiment.variant,
        "engine": engine,
        "version": __version__,
        "complete": "false" if reason else "true",
        "reason": reason,
    }


@dataclass
class Collector:
    """Gathers frames into a :class:`Run`, eight bytes a number."""

    _stamps: dict[str, "array[int]"] = field(default_factory=dict)
    _names: dict[str, Names] = field(default_factory=dict)
    _numbers: dict[str, dict[str, "array[float]"]] = field(default_factory=dict)

    def __call__(self, topic: Topic, frame: Frame) -> None:
        """Take one frame; as :meth:`fpt_ros.cycle.run.Run.frames` gives them."""
        key = topic.name
        if key not in self._stamps:
            self._stamps[key] = array("q")
            self._names[key] = frame.names
            self._numbers[key] = {name: array("d") for name in topic.vectors}
        vectors: Iterable[Vector] = frame[2:]
        if frame.names != self._names[key]:
            vectors = self._aligned(topic, frame)
        self._stamps[key].append(frame.stamp)
        for numbers, vector in zip(self._numbers[key].values(), vectors, strict=True):
            numbers.extend(vector)

    def _aligned(self, topic: Topic, frame: Frame) -> list[list[float]]:
        """The frame's vectors over all names met so far, which may grow."""
        key, known = topic.name, self._names[topic.name]
        new = tuple(name for name in frame.names if name not in known)
        if new:
            self._names[key] = known + new
            count = len(self._stamps[key])
            for name, numbers in self._numbers[key].items():
                old = np.frombuffer(numbers, dtype=np.float64).reshape(count, len(known))
                wide = np.full((count, len(known) + len(new)), np.nan)
                wide[:, : len(known)] = old
                self._numbers[key][name] = array("d", wide.tobytes())
        where = {name: i for i, name in enumerate(frame.names)}
        return [
            [vector[where[name]] if name in where else float("nan") for name in self._names[key]]
            for vector in frame[2:]
        ]

    @property
    def held(self) -> int:
        """Frames that are held."""
        return sum(map(len, self._stamps.values()))

    def complete(self) -> int:
        """Stamp before which no more frames come, if each topic is in order [ns]; 0: not known."""
        return min((stamps[-1] for stamps in self._stamps.values() if stamps), default=0)

    def drain(self, before: int) -> dict[str, Series]:
        """The frames before a stamp [ns], by topic; they are held no longer."""
        result = {}
        for name, series in self.topics().items():
            count = int(np.searchsorted(series.stamps, before))
            vectors = {key: matrix[:count] for key, matrix in series.vectors.items()}
            result[name] = Series(series.stamps[:count], series.names, vectors)
            del self._stamps[name][:count]
            for numbers in self._numbers[name].values():
                del numbers[: count * len(series.names)]
        return result

    def topics(self) -> dict[str, Series]:
        """The frames that are held, by topic, in the order of the cycle."""
        result = {}
        for topic in LOOP_TOPICS:
            if topic.name in self._stamps:
                names, count = self._names[topic.name], len(self._stamps[topic.name])
                # copies: an array that shares its memory with numpy could not grow any more
                vectors = {
                    key: np.array(numbers, dtype=np.float64).reshape(count, len(names))
                    for key, numbers in self._numbers[topic.name].items()
                }
                stamps = np.array(self._stamps[topic.name], dtype=np.int64)
                result[topic.name] = Series(stamps, names, vectors)
        return result
