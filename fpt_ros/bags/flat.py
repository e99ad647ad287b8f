"""Trajectories of one point as JointState: viewers plot these by the names of the joints.

Three topics of the loop are JointTrajectory, which PlotJuggler shows as ``points[0]/positions[2]``.
``/desired/flat`` says the same as ``/desired`` joint by joint. JointState has no accelerations:
they are the positions of a topic of their own, ``/desired/flat/accelerations``.
"""

import contextlib
import os
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple, cast

from fpt_ros.bags.bag import Bag
from fpt_ros.bags.block import Source
from fpt_ros.bags.chosen import Chosen
from fpt_ros.bags.copy import Copy
from fpt_ros.bags.definitions import full_name
from fpt_ros.errors import BadInput
from fpt_ros.laws import Vector
from fpt_ros.messages.cdr import Codec, MalformedMessage
from fpt_ros.messages.frames import JointStates, Names
from fpt_ros.messages.topics import (
    JOINT_STATE,
    JOINT_STATES,
    JOINT_TRAJECTORY,
    MESSAGE_FIELDS,
    Topic,
)

FLAT, ACCELERATIONS = "flat", "flat/accelerations"
"""What follows the name of the trajectory's topic."""


class _Trajectory(NamedTuple):
    """A message of one point; vectors may be empty."""

    stamp: int
    names: Names
    positions: Vector
    velocities: Vector
    accelerations: Vector
    effort: Vector


def is_flat(source: Source) -> bool:
    """Whether it was made here."""
    return source.type == JOINT_STATE and source.topic.endswith((f"/{FLAT}", f"/{ACCELERATIONS}"))


def write_flat(
    path: Path, file: Path, topics: tuple[str, ...] = ()
) -> tuple[dict[str, int], tuple[str, ...]]:
    """Write a recording again, with a flat view of its trajectories beside them.

    Args:
        path: a recording or one of its files, whoever made it.
        file: to write, appears when it is whole.
        topics: only these.

    Returns:
        Messages by topic; what the recording does not hold, and what has no flat view.

    Raises:
        BadInput: it is not a recording, has no such topic, or no messages.
        OSError: the file cannot be written.
    """
    bag = Bag(path)
    chosen = Chosen(topics)

    def wanted(source: Source) -> bool:
        return chosen(source) and not is_flat(source)

    part = file.with_name(f".{file.name}.part")
    part.unlink(missing_ok=True)
    views: dict[Source, _View] = {}
    try:
        copy = Copy(bag, part, wanted)
        for block in bag.blocks():
            copy.begin()
            for source, (stamp, start, end, _) in block.ordered():
                if not wanted(source):
                    continue
                data = bytes(block.data[start:end])
                copy.message(source, stamp, data)
                if full_name(source.type) == JOINT_TRAJECTORY:
                    for own, message in views.setdefault(source, _View(source.topic)).of(data):
                        copy.message(own, stamp, message)
        chosen.check(bag)
        copy.finish()
        if not copy.counts():
            raise BadInput(f"{path} holds nothing to export: it has no messages")
        os.replace(part, file)
    except BaseException:
        with contextlib.suppress(OSError):
            part.unlink(missing_ok=True)
        raise
    strange = [
        f"{view.strange} messages on {source.topic} have another number of points than one: they "
        "have no flat view"
        for source, view in views.items()
        if view.strange
    ]
    return copy.counts(), (*bag.missing, *strange)


class _View:
    """The flat view of one topic.

    Attributes:
        strange: messages without one.
    """

    def __init__(self, topic: str) -> None:
        fields = MESSAGE_FIELDS[JOINT_TRAJECTORY]
        self._read = Codec(Topic(topic, JOINT_TRAJECTORY, _Trajectory, fields))  # type: ignore[arg-type]
        self._write = Codec(JOINT_STATES)
        self._motion = Source(f"{topic}/{FLAT}", JOINT_STATE)
        self._accelerations = Source(f"{topic}/{ACCELERATIONS}", JOINT_STATE)
        self.strange = 0

    def of(self, data: bytes) -> Iterator[tuple[Source, bytes]]:
        """The messages that say the same as this one."""
        try:
            frame = cast(_Trajectory, self._read.decode(data))
        except MalformedMessage:
            self.strange += 1
            return
        stamp, names, positions, velocities, accelerations, effort = frame
        motion = JointStates(stamp, names, positions, velocities, effort)
        yield self._motion, self._write.encode(motion)
        if accelerations:
            response = JointStates(stamp, names, accelerations, (), ())
            yield self._accelerations, self._write.encode(response)
