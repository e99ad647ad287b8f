"""One number of one topic, of any recording: a signal."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from fpt_ros.bags import columns, numbers
from fpt_ros.bags.bag import Bag
from fpt_ros.bags.block import Source
from fpt_ros.bags.numbers import Part, Reading
from fpt_ros.errors import BadInput
from fpt_ros.messages.frames import SECOND

HEADER = "header.stamp"
"""Where messages of ROS tell when they were sent, or what they tell was measured."""


@dataclass(frozen=True)
class Signal:
    """A signal of a recording.

    Attributes:
        name: as in ``/joint_states.position.elbow``.
        stamps: (n,) times [ns], ascending: of recording, or of the clock that was asked for.
        values: (n,), NaN where a message lacks the number.
        warnings: what its user should know, a line each: damage of the recording, joints that
            change their places.
    """

    name: str
    stamps: NDArray[np.int64]
    values: NDArray[np.float64]
    warnings: tuple[str, ...] = ()


def read_field(
    path: Path, topic: str, field: str, joint: str | None = None, clock: str = ""
) -> Signal:
    """Read a signal.

    A joint is found by its name, wherever it stands in a message, and messages that do not name it
    (of another publisher on the topic) are left out. ``position[2]`` is the third element of every
    message, whosever it is.

    Args:
        path: a recording or one of its files, whoever made it.
        topic: with or without the first ``/``.
        field: ``position[2]``, ``position.elbow``, ``pose.position.x``, ``points[0].effort[1]``.
        joint: name of the joint, ``field`` then is the array, as ``position``.
        clock: field of the message that tells its time, as ``header.stamp``; by default the time at
            which it was recorded counts.

    Raises:
        BadInput: the recording cannot be read, or has no such topic, field or joint (says which
            there are), or nothing of it is left.
    """
    bag = Bag(path)
    wanted = {topic, f"/{topic.lstrip('/')}"}
    readings = numbers.read(bag, lambda source: source.topic in wanted)
    source, reading = _one_topic(bag, topic, wanted, readings)
    if reading.bad:
        bag.missing.append(f"{reading.bad} messages on {topic} cannot be read")
    picked = _Picked(topic, field, joint, reading)
    values, present = picked.values()
    if not picked.found:
        raise BadInput(picked.complaint())
    told = _told(reading, clock or HEADER, present)
    if clock and told is None:
        raise BadInput(f"--time {clock}: messages on {topic} have no such time, of sec and nanosec")
    stamps = told if clock and told is not None else reading.stamps[present]
    order = np.argsort(stamps, kind="stable")
    name = f"{source.topic}.{field}" + (f".{joint}" if joint else "")
    warnings = [*bag.missing, *bag.notes, *picked.warnings()]
    if told is not None and not clock and _unevenness(stamps) > max(0.1, 2 * _unevenness(told)):
        warnings.append(
            f"messages on {topic} were recorded at uneven times: --time {HEADER} takes those at "
            "which they were sent"
        )
    return Signal(name, stamps[order], values[present][order], tuple(warnings))


def _told(reading: Reading, clock: str, present: NDArray[np.bool_]) -> NDArray[np.int64] | None:
    """Times [ns] that the messages themselves tell; None: not all of them do."""
    stamps = np.zeros(len(present), dtype=np.int64)
    known = np.zeros(len(present), dtype=bool)
    for part in reading.parts:
        seconds, nanoseconds = (part.numbers.get(f"{clock}.{unit}") for unit in ("sec", "nanosec"))
        if seconds is not None and nanoseconds is not None:
            stamps[part.at] = seconds[:, 0].astype(np.int64) * SECOND + nanoseconds[:, 0]
            known[part.at] = True
    return stamps[present] if known[present].all() else None


def _unevenness(stamps: NDArray[np.int64]) -> float:
    """How far steps of time are from the middle one, in steps, on average; 0 for fewer than 3."""
    steps = np.diff(np.sort(stamps)).astype(float)
    middle = float(np.median(steps)) if len(steps) > 1 else 0.0
    return float(np.mean(np.abs(steps - middle))) / middle if middle > 0 else 0.0


def _one_topic(
    bag: Bag, topic: str, wanted: set[str], readings: dict[Source, Reading | BadInput]
) -> tuple[Source, Reading]:
    good = [(s, each) for s, each in readings.items() if isinstance(each, Reading)]
    if good:
        return max(good, key=lambda pair: len(pair[1].stamps))
    for each in readings.values():
        if isinstance(each, BadInput):
            raise each
    damage = f" ({'; '.join(bag.missing)})" if bag.missing else ""
    if any(source.topic in wanted for source in bag.kinds):
        raise BadInput(f"{bag.path} has no messages on {topic}{damage}")
    names = ", ".join(sorted({source.topic for source in bag.kinds})) or "none"
    raise BadInput(f"{bag.path} has no topic '{topic}': there are {names}{damage}")


class _Picked:
    """The column of a topic that a field, and perhaps a joint, mean."""

    def __init__(self, topic: str, field: str, joint: str | None, reading: Reading) -> None:
        self._topic, self._field, self._joint, self._reading = topic, field, joint, reading
        self._parts = sorted(reading.parts, key=lambda part: int(part.at.min()))
        self._owners: dict[str, None] = {}
        self._is_empty = False

    @property
    def found(self) -> bool:
        """After :meth:`values`: some message has it."""
        return bool(self._owners) or self._is_empty

    def values(self) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
        """(n,) numbers of all messages, and which of the messages have the joint or field."""
        count = len(self._reading.stamps)
        values = np.full(count, np.nan)
        present = np.zeros(count, dtype=bool)
        for part in self._parts:
            found = self._find(part)
            if found is not None:
                path, element, owner = found
                self._owners[owner] = None
                values[part.at] = part.numbers[path][:, element]
                present[part.at] = True
            elif self._names_it(part):
                present[part.at] = True
        self._is_empty = self._joint is not None and bool(present.any())
        return values, present

    def _find(self, part: Part) -> tuple[str, int, str] | None:
        names = columns.joints(part.layout)
        wanted = self._field if self._joint is None else f"{self._field}.{self._joint}"
        path, place = columns.split_element(wanted)
        for column in columns.columns(part):
            by_place = column.path == path and column.element == place and self._joint is None
            if column.name == wanted or by_place:
                own = column.joint or (
                    names[place] if place is not None and place < len(names) else ""
                )
                return column.path, column.element, own
        return None

    def _names_it(self, part: Part) -> bool:
        """The message has the joint or the array, but no number for it."""
        names = columns.joints(part.layout)
        if self._joint is not None:
            array = any(leaf.path == self._field for leaf in part.layout.leaves)
            return self._joint in names and array
        path, dot, last = self._field.rpartition(".")
        if dot and last in names:
            return any(leaf.path == path for leaf in part.layout.leaves)
        path, place = columns.split_element(self._field)
        return place is not None and any(leaf.path == path for leaf in part.layout.leaves)

    def warnings(self) -> list[str]:
        """Where a place is not always the same joint's."""
        if self._joint is None and len(self._owners) > 1:
            names = ", ".join(self._owners)
            changing = f"{self._field} of {self._topic} is not always the same joint's ({names})"
            return [f"{changing}: --joint NAME takes one by its name"]
        return []

    def complaint(self) -> str:
        """Why nothing was found."""
        names = columns.all_names(self._reading)
        known = {joint for part in self._reading.parts for joint in columns.joints(part.layout)}
        if self._joint is not None and self._joint not in known:
            if any(self._joint in part.layout.texts.values() for part in self._reading.parts):
                return f"--joint {self._joint}: messages on {self._topic} name a joint twice"
            there = ", ".join(sorted(known)) or "none"
            return f"--joint {self._joint}: {self._topic} has the joints {there}"
        if self._reading.left_out & {self._field, columns.split_element(self._field)[0]}:
            return f"--field {self._field} of {self._topic} has too many numbers to be a signal"
        if self._joint is None and any(
            name.startswith((f"{self._field}[", f"{self._field}.")) for name in names
        ):
            return (
                f"--field {self._field} of {self._topic} is not one number: as in "
                f"{next(n for n in names if n.startswith((self._field + '[', self._field + '.')))}"
            )
        shown = ", ".join(names[:40]) + (", ..." if len(names) > 40 else "") or "no numbers"
        return f"--field {self._field}: {self._topic} has no such number, it has {shown}"
