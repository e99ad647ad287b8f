"""Messages as they lie in a file: where they come from, and many of them at once."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Rows = NDArray[np.int64]
"""(n, 4) stamp [ns], first byte, byte behind the last, sequence."""


class Source(NamedTuple):
    """Where a message comes from: its topic, absolute, and the topic's type."""

    topic: str
    type: str


class Item(NamedTuple):
    """One message."""

    source: Source
    stamp: int
    """Log time [ns]."""
    data: bytes


@dataclass(frozen=True)
class Kind:
    """How the messages of a source are written.

    Attributes:
        encoding: of the messages: cdr, json, protobuf, ...
        form: of the definition: ros2msg, ros2idl, jsonschema, ...
        definition: of the type; empty: the file does not hold it.
        metadata: what else the file says about the topic, as offered_qos_profiles.
    """

    encoding: str
    form: str
    definition: bytes
    metadata: Mapping[str, str]


class Block(NamedTuple):
    """Some messages, one after the other: a chunk of a file."""

    data: bytes | memoryview
    rows: Mapping[Source, Rows]

    def items(self) -> Iterator[Item]:
        """The messages, in the order in which they were written."""
        for source, (stamp, start, end, _) in self.ordered():
            yield Item(source, stamp, bytes(self.data[start:end]))

    def ordered(self) -> Iterator[tuple[Source, tuple[int, int, int, int]]]:
        """(source, row) of the messages, in the order in which they were written."""
        pairs = [(row, source) for source, rows in self.rows.items() for row in rows.tolist()]
        pairs.sort(key=lambda pair: pair[0][1])
        for row, source in pairs:
            yield source, tuple(row)

    @property
    def total(self) -> int:
        """Number of messages."""
        return sum(map(len, self.rows.values()))
