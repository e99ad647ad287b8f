"""Frames of a loop gathered into series, one by one: beside what the engine keeps by itself."""

from array import array
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np

from fpt_ros.laws import Vector
from fpt_ros.messages.frames import Frame, Names
from fpt_ros.messages.topics import LOOP_TOPICS, Topic
from fpt_ros.runs.run import Series


@dataclass
class Collector:
    """Gathers frames into a :class:`Run`, eight bytes a number."""

    _stamps: dict[str, "array[int]"] = field(default_factory=dict)
    _names: dict[str, Names] = field(default_factory=dict)
    _numbers: dict[str, dict[str, "array[float]"]] = field(default_factory=dict)

    def __call__(self, topic: Topic, frame: Frame) -> None:
        """Take one frame; as a stage sends it."""
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
