"""Reading one MCAP file from front to back: all that is whole in it, and what is not."""

import mmap
import struct
import zlib
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path

import numpy as np
from mcap.data_stream import ReadDataStream
from mcap.exceptions import McapError
from mcap.records import Attachment, Channel, Metadata, Schema, Statistics

from fpt_ros.bags import chunk, records
from fpt_ros.bags.block import Block, Kind, Rows, Source
from fpt_ros.bags.chunk import BadChunk
from fpt_ros.bags.records import MAGIC, MESSAGE_HEAD, Gap, Record
from fpt_ros.errors import BadInput
from fpt_ros.messages.frames import SECOND

CUT = "the recording was cut"
DAMAGED = "the recording is damaged"

_BATCH = 4096
"""Messages outside of chunks that make a block."""

_LARGEST_STAMP = (1 << 63) - 1


class Scan:
    """One pass over a file.

    Attributes:
        attachments: by name, those met so far.
        metadata: records by name, those met so far.
        kinds: the topics met so far, with or without messages.
        counts: messages of each channel that the file's own statistics name.
        sources: of each channel.
        sequences: of each channel, one more than the last message's.
        damage: what is wrong with the file, a line each.
        cut: the file ends too early.
    """

    def __init__(self, path: Path, data: memoryview | None = None) -> None:
        """Raises BadInput: it cannot be read."""
        self.path = path
        self.attachments: dict[str, bytes] = {}
        self.metadata: dict[str, dict[str, str]] = {}
        self.kinds: dict[Source, Kind] = {}
        self.counts: dict[int, int] = {}
        self.sources: dict[int, Source] = {}
        self.sequences: dict[int, int] = {}
        self.damage: list[str] = []
        self.cut = False
        self._schemas: dict[int, Schema] = {}
        self._data = mapped(path) if data is None else data
        self._checked_to = 0
        self._ahead: list[tuple[int, int, int]] = []

    def blocks(self) -> Iterator[Block]:
        """All messages; when it is through, the attributes say the rest."""
        data, name = self._data, self.path.name
        if data[: len(MAGIC)] != MAGIC:
            self.damage.append(f"{name} does not begin as an MCAP file")
        self._read_ahead()
        loose: dict[int, list[int]] = {}
        count, ended = 0, False
        for step in records.walk(data, is_good=self._is_good):
            if isinstance(step, Gap):
                yield from self._gap(step)
                continue
            if step.opcode == records.MESSAGE:
                count += self._loose(loose, step)
                if count >= _BATCH:
                    yield self._block(data, loose)
                    loose, count = {}, 0
            elif step.opcode == records.CHUNK:
                if count:
                    yield self._block(data, loose)
                    loose, count = {}, 0
                yield from self._chunk(step)
            elif step.opcode == 0:
                ended = True
            else:
                self._take(step.opcode, data[step.at : step.end], step.start, step.end)
        if count:
            yield self._block(data, loose)
        self.cut = self.cut or not ended
        if not ended and not self.damage:
            self.damage.append(
                f"{name} was cut: it ends without its index, after {len(data)} bytes"
            )

    def _read_ahead(self) -> None:
        """Take the topics from the index too: the chunk that announces them may be damaged."""
        data, size = self._data, len(self._data)
        footer = size - len(MAGIC) - records.HEAD.size - 20
        if footer < 0 or data[footer] != records.FOOTER or data[-len(MAGIC) :] != MAGIC:
            return
        (start,) = struct.unpack_from("<Q", data, footer + records.HEAD.size)
        if not len(MAGIC) <= start < footer:
            return
        for step in records.walk(data[:footer], start):
            if isinstance(step, Record) and step.opcode in (records.SCHEMA, records.CHANNEL):
                self._ahead.append((step.opcode, step.at, step.end))

    def _learn_ahead(self) -> None:
        """What the index says of the topics."""
        for opcode, start, end in self._ahead:
            self._take(opcode, self._data[start:end], start)
        self._ahead = []

    def _gap(self, gap: Gap) -> Iterator[Block]:
        """Note what is damaged, and take what there is of a chunk that was being written."""
        name, rest = self.path.name, self._data[gap.start : gap.end]
        if not gap.cut:
            self.damage.append(f"{name}: bytes {gap.start} to {gap.end} are damaged")
            return
        self.cut = True
        where = f"byte {gap.start} of {len(self._data)}"
        zeros = not any(rest[-64:]) and len(rest) >= 64
        how = "ends in zeros after" if zeros else "was cut in the record that begins at"
        self.damage.append(f"{name} {how} {where}")
        if rest[0] == records.CHUNK:
            yield from self._parts(chunk.begun(rest[records.HEAD.size :]), gap.start)

    def _loose(self, rows: dict[int, list[int]], step: Record) -> int:
        """A message outside of chunks."""
        channel, sequence, stamp, _ = MESSAGE_HEAD.unpack_from(self._data, step.at)
        row = (stamp, step.at + MESSAGE_HEAD.size, step.end, sequence)
        rows.setdefault(channel, []).extend(row)
        return 1

    def _is_good(self, step: Record) -> bool:
        try:
            chunk.unpack(self._data[step.at : step.end])
        except BadChunk:
            return False
        return True

    def _chunk(self, step: Record) -> Iterator[Block]:
        body = self._data[step.at : step.end]
        try:
            yield from self._parts(chunk.unpack(body), step.start, whole=True)
        except BadChunk as error:
            first, last = chunk.span(body)
            self.damage.append(
                f"{self.path.name}: the chunk at byte {step.start}, messages from "
                f"{first / SECOND:g} to {last / SECOND:g} s, is damaged: {error}"
            )

    def _parts(self, data: bytes, start: int, whole: bool = False) -> Iterator[Block]:
        announced, rows = chunk.split(data, whole)
        for opcode, at, end in announced:
            self._take(opcode, memoryview(data)[at:end], start)
        yield self._block(data, rows)

    def _block(self, data: bytes | memoryview, found: dict[int, list[int]]) -> Block:
        rows: dict[Source, Rows] = {}
        for channel, flat in found.items():
            if channel not in self.sources:
                self._learn_ahead()
            source = self.sources.get(channel)
            if source is None:
                self.damage.append(
                    f"{self.path.name}: {len(flat) // 4} messages are of a topic that is not named"
                )
                continue
            try:
                own = np.array(flat, dtype=np.int64).reshape(-1, 4)
            except OverflowError:
                capped = [min(number, _LARGEST_STAMP) for number in flat]
                own = np.array(capped, dtype=np.int64).reshape(-1, 4)
            self.sequences[channel] = int(own[-1, 3]) + 1
            rows[source] = _merged(rows[source], own) if source in rows else own
        return Block(data, rows)

    def _take(self, opcode: int, body: memoryview, start: int, end: int = 0) -> None:
        """What is no message."""
        try:
            stream = ReadDataStream(BytesIO(body))
            if opcode == records.SCHEMA:
                schema = Schema.read(stream)
                self._schemas.setdefault(schema.id, schema)
            elif opcode == records.CHANNEL:
                self._announce(Channel.read(stream))
            elif opcode == records.ATTACHMENT:
                self._attach(body, Attachment.read(stream))
            elif opcode == records.METADATA:
                metadata = Metadata.read(stream)
                self.metadata[metadata.name] = metadata.metadata
            elif opcode == records.STATISTICS:
                self.counts = dict(Statistics.read(stream).channel_message_counts)
            elif opcode == records.DATA_END:
                self._check(struct.unpack("<I", body)[0], start, "messages and parameters")
                self._checked_to = end
            elif opcode == records.FOOTER:
                (crc,) = struct.unpack_from("<I", body, 16)
                self._check(crc, end - 4, "index", self._checked_to)
        except (McapError, struct.error, ValueError, KeyError) as error:
            self.damage.append(f"{self.path.name}: byte {start} is damaged: {error}")

    def _announce(self, channel: Channel) -> None:
        if channel.id in self.sources:
            return
        schema = self._schemas.get(channel.schema_id)
        source = Source(channel.topic, schema.name if schema else "")
        self.sources[channel.id] = source
        kind = Kind(
            channel.message_encoding,
            schema.encoding if schema else "",
            schema.data if schema else b"",
            channel.metadata,
        )
        self.kinds.setdefault(source, kind)

    def _attach(self, body: memoryview, attachment: Attachment) -> None:
        (crc,) = struct.unpack("<I", body[-4:])
        if crc and zlib.crc32(body[:-4]) != crc:
            self.damage.append(
                f"{self.path.name}: the attachment {attachment.name} is damaged: its checksum is "
                "another, its values may be"
            )
        self.attachments[attachment.name] = attachment.data

    def _check(self, crc: int, end: int, what: str, start: int = 0) -> None:
        """A checksum over many records: some byte of them is another."""
        if not crc or self.damage:
            return
        # with the magic in front, as most writers have it, or without
        for begin in (start,) if start else (0, len(MAGIC)):
            if zlib.crc32(self._data[begin:end]) == crc:
                return
        self.damage.append(f"{self.path.name}: the checksum over {what} is another")


def _merged(first: Rows, second: Rows) -> Rows:
    """Two channels of one source, in the order of the file."""
    both = np.concatenate([first, second])
    return both[np.argsort(both[:, 1], kind="stable")]


def mapped(path: Path) -> memoryview:
    """The bytes of a file.

    Raises:
        BadInput: it cannot be read.
    """
    try:
        with path.open("rb") as stream:
            if not path.stat().st_size:
                return memoryview(b"")
            return memoryview(mmap.mmap(stream.fileno(), 0, access=mmap.ACCESS_READ))
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise BadInput(f"{path} cannot be read: {reason}") from error
