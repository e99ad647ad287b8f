"""Messages as they lie in a file: where they come from, and many of them at once."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Rows = NDArray[np.int64]
"""(n, 4) stamp [ns], first byte, byte behind the last, sequence."""

LARGEST_STAMP = (1 << 63) - 1
"""Nanoseconds; later ones are taken for this."""


def as_rows(flat: Sequence[int]) -> Rows:
    """Stamp, first byte, byte behind the last, sequence of the first message, of the second, ..."""
    try:
        return np.array(flat, dtype=np.int64).reshape(-1, 4)
    except OverflowError:
        capped = [min(number, LARGEST_STAMP) for number in flat]
        return np.array(capped, dtype=np.int64).reshape(-1, 4)


def gather(data: bytes | memoryview, starts: NDArray[np.int64], size: int) -> NDArray[np.uint8]:
    """(n, size) bytes from each start on."""
    if not size or not len(starts):
        return np.empty((len(starts), size), dtype=np.uint8)
    pieces = np.ndarray((len(data) - size + 1,), f"V{size}", data, strides=(1,))
    return pieces[starts].view(np.uint8).reshape(len(starts), size)


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
