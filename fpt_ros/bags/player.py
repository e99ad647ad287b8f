"""Handing a recording on, chunk by chunk, while it is read."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from fpt_ros.messages.frames import Frame
from fpt_ros.messages.topics import LOOP_TOPICS, Topic
from fpt_ros.parameters import Values
from fpt_ros.runs.chunks import CHUNK, Consumer, ordered
from fpt_ros.runs.run import Collector

FRAMES = CHUNK * len(LOOP_TOPICS)
"""Messages that are collected before they are handed on."""


class Player:
    """Collects frames, and hands them on when there is a chunk of whole cycles."""

    def __init__(self, make: Callable[[Mapping[str, Values]], Sequence[Consumer]]) -> None:
        self._make = make
        self._consumers: Sequence[Consumer] | None = None
        self._collector = Collector()
        self._full = FRAMES
        self._count = 0

    def begin(self, parameters: Mapping[str, Values]) -> None:
        """What stands in front of the messages."""
        if self._consumers is None:
            self._consumers = self._make(parameters)

    def __call__(self, topic: Topic, frame: Frame) -> None:
        """Take one frame."""
        self._collector(topic, frame)
        self._count += 1
        if self._count >= self._full:
            self._give(self._collector.complete())
            self._count = self._collector.held
            # a topic that has ended holds all others up: look again, but not all the time
            self._full = max(FRAMES, 2 * self._count)

    def _give(self, before: int) -> None:
        chunk = ordered(self._collector.drain(before))
        for consumer in self._consumers or ():
            consumer.take(chunk)

    def finish(self, parameters: Mapping[str, Values]) -> None:
        """Hand on what is left."""
        self.begin(parameters)
        self._give(np.iinfo(np.int64).max)
