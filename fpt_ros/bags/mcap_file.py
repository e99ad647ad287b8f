"""Writing one MCAP file: chunks of messages, compressed, each whole as soon as it is written."""

import os
import struct
import zlib
from array import array
from collections.abc import Mapping
from pathlib import Path
from typing import Protocol, Self

import zstandard
from mcap.data_stream import RecordBuilder
from mcap.records import Attachment, Channel, Header, Metadata, Schema

from fpt_ros.bags import records
from fpt_ros.bags.left import Left
from fpt_ros.bags.records import MAGIC
from fpt_ros.bags.side_file import SideFile, write_all
from fpt_ros.bags.summary import Chunk, Summary

CHUNK_SIZE = 256 * 1024
"""Bytes of messages that make a chunk full: a tenth of a second of a fast loop."""

LEVEL = 1
"""Of compression: the fastest; level 3 makes files of the loop 4 percent smaller."""

_MESSAGE = struct.Struct("<BQHIQQ")
_CHUNK = struct.Struct("<BQQQQII4sQ")
_INDEX = struct.Struct("<BQHI")


class _Record(Protocol):
    def write(self, stream: RecordBuilder) -> None: ...


class McapFile:
    """Writes one MCAP file. Not shared between threads; every method may raise OSError.

    Attributes:
        counts: messages so far, by channel.
        size: bytes so far, those of the open chunk as they are before compression.
        finished: whether the summary has been written: nothing can be added any more.
    """

    _side: SideFile | None

    def __init__(self, path: Path, profile: str, library: str, aside: bool = False) -> None:
        """``aside``: keep the messages of the open chunk in a file beside."""
        self._begin(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666), profile, library)
        self._write(self._head)
        if aside:
            self._side = SideFile(path, self._head)

    def _begin(self, file: int, profile: str, library: str) -> None:
        self._file = file
        self._head = MAGIC + _bytes(Header(profile=profile, library=library))
        self._written, self._crc = 0, 0
        self._chunk = bytearray()
        self._rows: dict[int, array[int]] = {}
        self._announced = b""
        self._schemas: dict[str, int] = {}
        self._summary = Summary()
        self._pack = zstandard.ZstdCompressor(level=LEVEL)
        self.counts: dict[int, int] = {}
        self._first = self._last = -1
        self._span: tuple[int, int] | None = None
        self._side = None
        self.finished = False

    @classmethod
    def reopened(cls, left: Left, profile: str, library: str) -> Self:
        """Go on with a file that a killed process has left, and a side file of its own."""
        file = cls.__new__(cls)
        file._begin(os.open(left.path, os.O_WRONLY), profile, library)
        os.ftruncate(file._file, left.size)
        os.lseek(file._file, left.size, os.SEEK_SET)
        file._written, file._crc = left.size, left.crc
        file._summary = left.summary
        file._schemas = {each.name: each.id for each in left.summary.schemas}
        file._chunk += left.announcements
        file._announced = left.announcements
        for channel in left.summary.channels:
            file.counts[channel.id] = left.count(channel.id)
        chunks = left.summary.chunks
        if chunks:
            file._span = min(each.first for each in chunks), max(each.last for each in chunks)
        for each in left.aside:
            file.message(*each)
        file.flush()
        file._side = SideFile(left.path, file._head + left.announcements, again=True)
        return file

    def attach(self, name: str, media_type: str, data: bytes) -> None:
        """Add a file of its own, outside the messages."""
        self.flush()
        attachment = Attachment(0, 0, name, media_type, data)
        record = _bytes(attachment)
        self._summary.attachment(attachment, self._written, len(record))
        self._write(record)

    def metadata(self, name: str, values: Mapping[str, str]) -> None:
        """Add a record of names and words, behind the messages so far."""
        self.flush()
        record = _bytes(Metadata(name=name, metadata=dict(values)))
        self._summary.metadata(name, self._written, len(record))
        self._write(record)

    def add_channel(
        self,
        topic: str,
        schema: str,
        definition: bytes,
        metadata: Mapping[str, str],
        form: str = "ros2msg",
        encoding: str = "cdr",
    ) -> int:
        """Announce a topic; returns its channel."""
        self._close_chunk()
        out = b""
        if schema and schema not in self._schemas:
            number = self._schemas[schema] = len(self._schemas) + 1
            about = Schema(id=number, data=definition, encoding=form, name=schema)
            self._summary.schemas.append(about)
            out += _bytes(about)
        channel = Channel(
            id=len(self.counts) + 1,
            topic=topic,
            message_encoding=encoding,
            metadata=dict(metadata),
            schema_id=self._schemas.get(schema, 0),
        )
        self._summary.channels.append(channel)
        out += _bytes(channel)
        self.counts[channel.id] = 0
        self._announced += out
        self._chunk += out  # at the beginning of the next chunk, where readers look for it
        if self._side is not None:
            self._side.announce(out)
        return channel.id

    def message(self, channel: int, stamp: int, data: bytes, published: int | None = None) -> None:
        """Add a message; ``stamp`` [ns] is its log time, and publish time if none is given."""
        sequence = self.counts[channel]
        record = _MESSAGE.pack(
            records.MESSAGE, 22 + len(data), channel, sequence, stamp, published or stamp
        ) + bytes(data)
        if self._side is not None:
            self._side.add(record)
        at = len(self._chunk)
        self._chunk += record
        self.counts[channel] = sequence + 1
        rows = self._rows.get(channel)
        if rows is None:
            self._rows[channel] = array("Q", (stamp, at))
        else:
            rows.extend((stamp, at))
        if self._first < 0:
            self._first = self._last = stamp
        elif stamp > self._last:
            self._last = stamp
        elif stamp < self._first:
            self._first = stamp
        if at > CHUNK_SIZE:
            self.flush()

    @property
    def span(self) -> tuple[int, int]:
        """First and last stamp [ns]; zeros without messages."""
        spans = [each for each in (self._span, self._open_span) if each is not None]
        return (min(s[0] for s in spans), max(s[1] for s in spans)) if spans else (0, 0)

    @property
    def _open_span(self) -> tuple[int, int] | None:
        return None if self._first < 0 else (self._first, self._last)

    @property
    def size(self) -> int:
        """Bytes so far."""
        return self._written + len(self._chunk)

    def flush(self) -> None:
        """Hand all messages so far to the operating system, as a chunk."""
        if os.fstat(self._file).st_nlink == 0:
            raise FileNotFoundError(2, "it has been removed")
        self._close_chunk()

    def _close_chunk(self) -> None:
        """Only announcements in it stay for the next one."""
        if not self._rows:
            return
        packed = self._pack.compress(self._chunk)
        head = _CHUNK.pack(
            records.CHUNK, 44 + len(packed), self._first, self._last, len(self._chunk),
            zlib.crc32(self._chunk), 4, b"zstd", len(packed),
        )  # fmt: skip
        start, at = self._written, self._written + len(head) + len(packed)
        out, offsets = [head, packed], {}
        for channel, rows in self._rows.items():
            offsets[channel] = at
            raw = rows.tobytes()
            out.append(_INDEX.pack(records.MESSAGE_INDEX, 6 + len(raw), channel, len(raw)) + raw)
            at += len(out[-1])
        self._write(b"".join(out))
        self._summary.chunks.append(
            Chunk(
                start, len(head) + len(packed), offsets, at - start - len(head) - len(packed),
                len(packed), len(self._chunk), self._first, self._last,
            )
        )  # fmt: skip
        self._span = self.span
        if self._side is not None:
            self._side.clear()
        self._chunk, self._rows, self._announced = bytearray(), {}, b""
        self._first = self._last = -1

    def finish(self) -> None:
        """Write the summary and close."""
        if not self.finished:
            self.flush()
            if self._chunk:  # topics without messages
                self._write(self._announced)
                self._chunk = bytearray()
            self._write(self._summary.end(self._written, self._crc, self.counts, self.span))
            self.finished = True
        self.close()

    def close(self) -> None:
        """Close without a summary: the file then counts as cut."""
        if self._file < 0:
            return
        file, self._file = self._file, -1
        if self._side is not None:
            self._side.close(keep=not self.finished)
        os.close(file)

    def _write(self, data: bytes) -> None:
        try:
            write_all(self._file, data)
        except OSError:
            # no half record stays; what the side file holds still belongs behind the last one
            os.ftruncate(self._file, self._written)
            os.lseek(self._file, self._written, os.SEEK_SET)
            raise
        self._crc = zlib.crc32(data, self._crc)
        self._written += len(data)


def _bytes(record: _Record) -> bytes:
    builder = RecordBuilder()
    record.write(builder)
    return bytes(builder.end())
