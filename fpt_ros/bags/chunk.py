"""The messages of one MCAP chunk, checked before any of them is used."""

import struct
import zlib
from collections.abc import Sequence

import lz4.frame  # type: ignore[import-untyped]
import numpy as np
import zstandard
from numpy.typing import NDArray

from fpt_ros.bags.block import LARGEST_STAMP, Rows, as_rows, gather
from fpt_ros.bags.records import CHANNEL, HEAD, MESSAGE, MESSAGE_HEAD, SCHEMA

LARGEST = 1 << 31
"""Bytes of a chunk; what claims to be larger is damaged."""

_HEAD = struct.Struct("<QQQI")
_MESSAGE = struct.Struct("<BQHIQQ")
assert _MESSAGE.size == HEAD.size + MESSAGE_HEAD.size
_FIELDS = np.dtype(
    [
        ("opcode", "u1"), ("length", "<u8"), ("channel", "<u2"), ("sequence", "<u4"),
        ("stamp", "<u8"), ("published", "<u8"),
    ]
)  # fmt: skip
"""The same for numpy."""

Announced = tuple[int, int, int]
"""Of a schema or channel: opcode, first byte, byte behind the last."""

Split = tuple[list[Announced], dict[int, Rows]]
"""Schemas and channels, and the messages by channel."""


class BadChunk(ValueError):
    """A chunk whose bytes are not those that were written."""


def span(body: memoryview) -> tuple[int, int]:
    """Log times [ns] of its first and last message, as its head says."""
    first, last, _, _ = _HEAD.unpack_from(body)
    return first, last


def unpack(body: memoryview) -> bytes:
    """The records of a chunk.

    Raises:
        BadChunk: they cannot be decompressed, or have another checksum.
    """
    _, _, size, crc = _HEAD.unpack_from(body)
    (length,) = struct.unpack_from("<I", body, _HEAD.size)
    at = _HEAD.size + 4
    compression = bytes(body[at : at + length])
    packed = body[at + length + 8 :]
    if size > LARGEST:
        raise BadChunk("it claims to be too large")
    try:
        data = _decompress(compression, packed, size)
    except (zstandard.ZstdError, RuntimeError, EOFError, MemoryError) as error:
        raise BadChunk(f"it cannot be decompressed: {error}") from error
    if len(data) != size:
        raise BadChunk("it has another size than it should")
    if crc and zlib.crc32(data) != crc:
        raise BadChunk("its checksum is another")
    return data


def begun(body: memoryview) -> bytes:
    """What there is of the records of a chunk that the file ends in."""
    try:
        (length,) = struct.unpack_from("<I", body, _HEAD.size)
        at = _HEAD.size + 4
        compression = bytes(body[at : at + length])
        packed = body[at + length + 8 :]
        if compression == b"zstd":
            return bytes(zstandard.ZstdDecompressor().decompressobj().decompress(packed))
        if compression == b"lz4":
            return bytes(lz4.frame.LZ4FrameDecompressor().decompress(packed, max_length=LARGEST))
        return b"" if compression else bytes(packed)
    except (zstandard.ZstdError, RuntimeError, EOFError, MemoryError, struct.error):
        return b""


def _decompress(compression: bytes, packed: memoryview, size: int) -> bytes:
    if compression == b"zstd":
        said = zstandard.frame_content_size(packed)
        if said not in (size, -1):
            raise BadChunk("it has another size than it should")
        return bytes(zstandard.ZstdDecompressor().decompress(packed, max_output_size=size))
    if compression == b"lz4":
        return bytes(lz4.frame.LZ4FrameDecompressor().decompress(packed, max_length=size + 1))
    if compression == b"":
        return bytes(packed)
    raise BadChunk(f"it is compressed by '{compression.decode(errors='replace')}', not known here")


def split_by_index(data: bytes, index: Sequence[tuple[int, memoryview]]) -> Split | None:
    """The same as :func:`split` of a whole chunk, many times faster, by the index behind it.

    Nothing is taken on trust: the messages have to be those of the index, and together with schemas
    and channels they have to be the chunk. ``None``: they are not, or there is no index.

    Args:
        data: records of the chunk.
        index: channel and entries (log time and offset, 8 bytes each) of its message indexes.
    """
    entries = [np.frombuffer(raw, dtype="<u8").reshape(-1, 2) for _, raw in index]
    if not sum(map(len, entries)):
        return None
    stamps, offsets = np.concatenate(entries).T
    if offsets.max() > len(data) - _MESSAGE.size:
        return None
    order = np.argsort(offsets, kind="stable")
    starts = offsets[order].astype(np.int64)
    heads = gather(data, starts, _MESSAGE.size).view(_FIELDS)[:, 0]
    channels = np.repeat([channel for channel, _ in index], [len(each) for each in entries])
    good = (
        (heads["opcode"] == MESSAGE).all()
        and (heads["length"] <= len(data)).all()
        and (heads["channel"] == channels[order]).all()
        and (heads["stamp"] == stamps[order]).all()
        and (heads["stamp"] <= LARGEST_STAMP).all()
    )
    if not good:
        return None
    ends = starts + HEAD.size + heads["length"].astype(np.int64)
    announced = _between(data, starts, ends)
    if announced is None:
        return None
    whole = np.empty((len(starts), 4), dtype=np.int64)
    whole[:, 0], whole[:, 1] = heads["stamp"], starts + _MESSAGE.size
    whole[:, 2], whole[:, 3] = ends, heads["sequence"]
    rows = {channel: whole[heads["channel"] == channel] for channel in set(channels.tolist())}
    return announced, rows


def _between(
    data: bytes, starts: NDArray[np.int64], ends: NDArray[np.int64]
) -> list[Announced] | None:
    """Schemas and channels in front of, between and behind messages; ``None``: something else."""
    gaps = np.flatnonzero(np.append(starts, len(data)) != np.append(0, ends))
    announced: list[Announced] = []
    for gap in gaps.tolist():
        at = int(ends[gap - 1]) if gap else 0
        stop = int(starts[gap]) if gap < len(starts) else len(data)
        while at < stop:
            if at + HEAD.size > stop:
                return None
            opcode, length = HEAD.unpack_from(data, at)
            end = at + HEAD.size + length
            if opcode == MESSAGE:
                return None
            if opcode in (SCHEMA, CHANNEL):
                announced.append((opcode, at + HEAD.size, end))
            at = end
        if at != stop:
            return None
    return announced


def split(data: bytes, whole: bool = True) -> Split:
    """Schemas and channels of a chunk, and where its messages lie.

    Args:
        data: its records.
        whole: they have to end with the chunk; else the last one may be cut.

    Returns:
        Schemas and channels; messages by channel.

    Raises:
        BadChunk: its records do not follow each other.
    """
    announced: list[Announced] = []
    rows: dict[int, list[int]] = {}
    at, size = 0, len(data)
    unpack, head, last = _MESSAGE.unpack_from, HEAD.size, size - _MESSAGE.size
    while at <= last:
        opcode, length, channel, sequence, stamp, _ = unpack(data, at)
        end = at + head + length
        if end > size:
            break
        if opcode == MESSAGE:
            if channel in rows:
                rows[channel] += (stamp, at + 31, end, sequence)
            else:
                rows[channel] = [stamp, at + 31, end, sequence]
        elif opcode in (SCHEMA, CHANNEL):
            announced.append((opcode, at + head, end))
        at = end
    while at + head <= size:  # shorter than a message
        opcode, length = HEAD.unpack_from(data, at)
        end = at + head + length
        if end > size:
            break
        if opcode in (SCHEMA, CHANNEL):
            announced.append((opcode, at + head, end))
        at = end
    if whole and at != size:
        raise BadChunk("its records do not follow each other")
    return announced, {channel: as_rows(flat) for channel, flat in rows.items()}
