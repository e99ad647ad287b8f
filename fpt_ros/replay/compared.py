"""Comparing what was recorded with what comes now: equal to the last bit, or where first not."""

import math
import struct
from dataclasses import dataclass

from fpt_ros.messages.cdr import Codec, MalformedMessage
from fpt_ros.messages.frames import SECOND, Frame
from fpt_ros.messages.topics import Topic

Value = float | str | None
"""A number, names, or nothing: there is no message."""

STAMP, NAMES = "header.stamp", "names"


@dataclass(frozen=True)
class Difference:
    """One place in which a message differs.

    Attributes:
        topic: its name, absolute.
        field: as in ``accelerations.q2``; ``header.stamp`` where one side has no message.
        cycle: of the run, from 0.
        recorded, now: what stands there.
    """

    topic: str
    field: str
    cycle: int
    recorded: Value
    now: Value

    def __str__(self) -> str:
        return (
            f"{self.topic} differs first in cycle {self.cycle}: {self.field} "
            f"{_text(self.recorded)} is recorded, {_text(self.now)} now"
        )


class Comparison:
    """Compares messages one by one, those of a cycle in the order of events.

    Attributes:
        first: difference, of the earliest cycle; None: all are equal so far.
        compared, differing: messages.
        cycles: in which something was compared.
        begin: the first of them, -1 before.
    """

    def __init__(self, prefix: str = "") -> None:
        """``prefix``: namespace of the topics, without the last ``/``."""
        self.first: Difference | None = None
        self.compared = self.differing = self.cycles = 0
        self._prefix = prefix
        self._codecs: dict[str, Codec] = {}
        self._cycle = self.begin = -1

    @property
    def equal(self) -> bool:
        """No message differs, to the last bit."""
        return self.first is None

    def add(self, topic: Topic, cycle: int, recorded: bytes | None, now: Frame | None) -> bool:
        """One message of a cycle, None where there is none; true if both are equal."""
        self.compared += 1
        if cycle != self._cycle:
            self._cycle, self.cycles = cycle, self.cycles + 1
            self.begin = cycle if self.begin < 0 else self.begin
        found = self._difference(topic, recorded, now)
        if found is None:
            return True
        self.differing += 1
        if self.first is None or cycle < self.first.cycle:
            self.first = Difference(f"{self._prefix}/{topic.name}", found[0], cycle, *found[1:])
        return False

    def is_same(self, topic: Topic, recorded: bytes, now: Frame) -> bool:
        """Whether a message would be equal; it is not counted."""
        return self._difference(topic, recorded, now) is None

    def _difference(
        self, topic: Topic, recorded: bytes | None, now: Frame | None
    ) -> tuple[str, Value, Value] | None:
        codec = self._codecs.setdefault(topic.name, Codec(topic))
        if recorded is not None and now is not None and codec.encode(now) == recorded:
            return None
        try:
            was = codec.decode(recorded) if recorded is not None else None
        except MalformedMessage:
            return "message", "one that is not whole", now and now.stamp / SECOND
        return first_field(topic, was, now)


def first_field(
    topic: Topic, recorded: Frame | None, now: Frame | None
) -> tuple[str, Value, Value] | None:
    """The first place in which two frames differ, and what stands there; None: they are equal.

    NaN is equal to NaN, 0.0 not to -0.0.
    """
    if recorded is None or now is None or recorded.stamp != now.stamp:
        stamps = [None if each is None else each.stamp / SECOND for each in (recorded, now)]
        return STAMP, stamps[0], stamps[1]
    if recorded.names != now.names:
        return NAMES, ", ".join(recorded.names), ", ".join(now.names)
    for vector, one, other in zip(topic.vectors, recorded[2:], now[2:], strict=True):
        if len(one) != len(other):
            return vector, f"{len(one)} numbers", f"{len(other)} numbers"
        for name, x, y in zip(now.names, one, other, strict=False):
            if struct.pack("d", x) != struct.pack("d", y) and not (x != x and y != y):
                return f"{vector}.{name}", x, y
    return None


def plain(value: Value) -> Value:
    """As JSON has it: numbers that are not finite as words."""
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value


def _text(value: Value) -> str:
    return "nothing" if value is None else value if isinstance(value, str) else repr(value)
