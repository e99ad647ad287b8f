"""A field of a recording's topic as a table: the one place that reads recordings for a signal."""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from fpt_ros.errors import BadInput
from fpt_ros.tables.table import Column, Kind, Table

STEP = re.compile(r"\w+|\[\d+\]")
"""A step of a field's path: a name, or an index."""


def read_recording(path: Path, topic: str, field: str) -> Table:
    """The times [s] and values of a field.

    Args:
        path: a recording's directory, or its file.
        topic, field: as in ``/joint_states`` and ``position[2]``.

    Raises:
        BadInput: it cannot be read, or the topic or the field is not there (lists those that are).
    """
    from rosbags.highlevel import AnyReader, AnyReaderError
    from rosbags.typesys import Stores, get_typestore

    steps = list(_steps(field))
    stamps, values = [], []
    try:
        with AnyReader([path], default_typestore=get_typestore(Stores.ROS2_JAZZY)) as bag:
            wanted = {topic, f"/{topic.lstrip('/')}"}
            connections = [each for each in bag.connections if each.topic in wanted]
            if not connections:
                names = ", ".join(sorted({each.topic for each in bag.connections}))
                raise BadInput(f"{path} has no topic '{topic}': there are {names}")
            for connection, stamp, raw in bag.messages(connections=connections):
                message = bag.deserialize(raw, connection.msgtype)
                stamps.append(stamp)
                values.append(_follow(message, steps, field, topic))
    except (AnyReaderError, OSError) as error:
        raise BadInput(f"{path} cannot be read as a recording: {error}") from error
    if not values:
        raise BadInput(f"{path} has no messages on {topic}")
    time = Column("time", Kind.NUMBER, np.array(stamps, dtype=np.int64) / 1e9, "s", "time")
    name = f"{topic}.{field}"
    return Table((time, Column(name, Kind.NUMBER, np.array(values))), str(path), "recording")


def _follow(message: Any, steps: list[str], field: str, topic: str) -> float:
    at = message
    for step in steps:
        if step.startswith("["):
            index = int(step[1:-1])
            if not hasattr(at, "__len__") or index >= len(at):
                raise BadInput(f"--field {field}: {topic} has no element {step} there")
            at = at[index]
        elif hasattr(at, step):
            at = getattr(at, step)
        else:
            names = ", ".join(n for n in vars(at) if not n.startswith("_")) or "nothing below it"
            raise BadInput(f"--field {field}: {topic} has no '{step}', it has {names}")
    try:
        return float(at)
    except (TypeError, ValueError):
        hint = ", as in position[0]" if hasattr(at, "__len__") else ""
        raise BadInput(f"--field {field} of {topic} is not one number{hint}") from None


def _steps(field: str) -> Iterator[str]:
    steps = STEP.findall(field)
    if not steps or "".join(steps) != field.replace(".", ""):
        raise BadInput(f"--field {field} is not a path like points[0].positions[1]")
    yield from steps
