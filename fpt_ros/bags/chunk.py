"""The messages of one MCAP chunk, checked before any of them is used."""

import struct
import zlib

import lz4.frame  # type: ignore[import-untyped]
import zstandard

from fpt_ros.bags.records import CHANNEL, HEAD, MESSAGE, MESSAGE_HEAD, SCHEMA

LARGEST = 1 << 31
"""Bytes of a chunk; what claims to be larger is damaged."""

_HEAD = struct.Struct("<QQQI")
_MESSAGE = struct.Struct("<BQHIQQ")
assert _MESSAGE.size == HEAD.size + MESSAGE_HEAD.size


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


def split(
    data: bytes, whole: bool = True
) -> tuple[list[tuple[int, int, int]], dict[int, list[int]]]:
    """Schemas and channels of a chunk, and where its messages lie.

    Args:
        data: its records.
        whole: they have to end with the chunk; else the last one may be cut.

    Returns:
        (opcode, first byte, byte behind the last) of schemas and channels; channel -> stamp,
        first byte, byte behind the last, sequence of its first message, of its second, ...

    Raises:
        BadChunk: its records do not follow each other.
    """
    announced: list[tuple[int, int, int]] = []
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
    return announced, rows
