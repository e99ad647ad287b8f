"""A field of a recording's topic as a table of times and values."""

from pathlib import Path

import numpy as np

from fpt_ros.bags.one_field import read_field
from fpt_ros.tables.table import Column, Kind, Table


def read_recording(
    path: Path, topic: str, field: str, joint: str | None = None, clock: str = ""
) -> Table:
    """The times [s] and values of a field, of any recording (:mod:`fpt_ros.bags.one_field`).

    Args:
        path: a recording's directory, or one of its files.
        topic, field: as in ``/joint_states`` and ``position[2]``, or ``position`` with a joint.
        joint: its name; found by name, wherever it stands in a message.
        clock: field that tells the time, as ``header.stamp``; by default that of recording.

    Raises:
        BadInput: it cannot be read, or the topic, field or joint is not there (lists those that
            are).
    """
    signal = read_field(path, topic, field, joint, clock)
    time = Column("time", Kind.NUMBER, signal.stamps / 1e9, "s", "time")
    values = Column(signal.name.lstrip("/"), Kind.NUMBER, np.asarray(signal.values))
    return Table((time, values), str(path), "recording", signal.warnings)
