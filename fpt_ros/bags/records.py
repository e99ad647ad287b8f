"""Walking over the records of an MCAP file, past what is damaged.

All records but messages say their length twice: in front, and by the lengths of their parts. Where
the two differ, where an opcode is unknown, or a record would reach beyond the end, the walk looks
for the next place from which records follow each other again.
"""

import re
import struct
from collections.abc import Callable, Iterator
from typing import Literal, NamedTuple

MAGIC = b"\x89MCAP0\r\n"

HEADER, FOOTER, SCHEMA, CHANNEL, MESSAGE, CHUNK, MESSAGE_INDEX = 1, 2, 3, 4, 5, 6, 7
ATTACHMENT, STATISTICS, METADATA, DATA_END = 9, 11, 12, 15

HEAD = struct.Struct("<BQ")
"""Opcode and length of the body."""

MESSAGE_HEAD = struct.Struct("<HIQQ")
"""Channel, sequence, log time, publish time."""

_SHAPES: dict[int, tuple[int | Literal["short", "long"], ...]] = {
    HEADER: ("short", "short"),
    FOOTER: (20,),
    SCHEMA: (2, "short", "short", "short"),
    CHANNEL: (4, "short", "short", "short"),
    CHUNK: (28, "short", "long"),
    MESSAGE_INDEX: (2, "short"),
    8: (32, "short", 8, "short", 16),
    ATTACHMENT: (16, "short", "short", "long", 4),
    10: (40, "short", "short"),
    STATISTICS: (42, "short"),
    METADATA: ("short", "short"),
    13: (16, "short"),
    14: (17,),
    DATA_END: (4,),
}
"""Parts of the records: a number of bytes, or a length (4 or 8 bytes) and as many bytes."""

_SHORT, _LONG = struct.Struct("<I"), struct.Struct("<Q")
_CANDIDATE = re.compile(rb"(?=[\x01-\x0f].{5}\x00\x00\x00)", re.DOTALL)
_CHAIN = 3
"""Records that have to follow a message that is taken for one after damage."""


class Record(NamedTuple):
    """One record: its opcode, where it starts, and where its body lies."""

    opcode: int
    start: int
    at: int
    end: int


class Gap(NamedTuple):
    """Bytes that are no records; ``cut``: the file ends in them."""

    start: int
    end: int
    cut: bool


def walk(
    data: memoryview,
    start: int = len(MAGIC),
    is_good: Callable[[Record], bool] = lambda record: True,
) -> Iterator[Record | Gap]:
    """Records and gaps of a file, in order; the magic at the end is a record of opcode 0.

    ``is_good`` is asked of a chunk behind which there is no record: a bad one may be too short.
    """
    at, size = start, len(data)
    previous: Record | None = None
    while at < size:
        if size - at == len(MAGIC) and data[at:] == MAGIC:
            if previous is not None:
                yield previous
            yield Record(0, at, at, size)
            return
        end = _end(data, at, size)
        if end is not None:
            if previous is not None:
                yield previous
            opcode = data[at]
            previous = Record(opcode, at, at + HEAD.size, end)
            at = end
            continue
        # the record in front may be what has led us here: its own length may be wrong
        if previous is not None and _misled(data, at, size, previous, is_good):
            at = previous.start
        elif previous is not None:
            yield previous
        previous = None
        found = _resume(data, at + 1, size)
        yield Gap(at, found, found == size)
        at = found
    if previous is not None:
        yield previous


def _misled(
    data: memoryview, at: int, size: int, previous: Record, is_good: Callable[[Record], bool]
) -> bool:
    if previous.opcode == CHUNK:
        return not is_good(previous)
    begins = size - at < HEAD.size or 1 <= data[at] <= DATA_END
    return previous.opcode == MESSAGE and not begins


def _end(data: memoryview, at: int, size: int) -> int | None:
    """Where the record that starts here ends; ``None``: there is none."""
    body = at + HEAD.size
    if body > size:
        return None
    opcode, length = HEAD.unpack_from(data, at)
    end: int = body + length
    if end > size:
        return None
    if opcode == MESSAGE:
        return end if length >= MESSAGE_HEAD.size else None
    shape = _SHAPES.get(opcode)
    if shape is None:
        # a private record is skipped, if another one follows
        known = opcode >= 0x80 and end < size and 1 <= data[end] <= DATA_END
        return end if known else None
    for part in shape:
        if part == "short":
            if body + 4 > end:
                return None
            body += 4 + _SHORT.unpack_from(data, body)[0]
        elif part == "long":
            if body + 8 > end:
                return None
            body += 8 + _LONG.unpack_from(data, body)[0]
        else:
            body += part
    return end if body == end else None


def _resume(data: memoryview, at: int, size: int) -> int:
    """The next place from which records follow each other; the end where there is none."""
    for found in _CANDIDATE.finditer(data, at):
        start = place = found.start()
        for _ in range(_CHAIN):
            end = _end(data, place, size)
            if end is None or data[place] in (CHUNK, ATTACHMENT, METADATA):
                break
            place = end
            if place >= size - len(MAGIC):
                break
        if end is not None:
            return start
    return size
