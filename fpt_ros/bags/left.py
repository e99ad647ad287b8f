"""What a process that was killed has left of a recording file, so that another one goes on with it.

The index behind each chunk says of which topic and stamp its messages are, so that no chunk has to
be decompressed but the last one, whose index may not be whole.
"""

import struct
import zlib
from io import BytesIO
from pathlib import Path

import numpy as np
from mcap.data_stream import ReadDataStream
from mcap.records import Attachment, Channel, Metadata, Schema
from numpy.typing import NDArray

from fpt_ros.bags import chunk, records
from fpt_ros.bags.chunk import BadChunk
from fpt_ros.bags.files import SIDE
from fpt_ros.bags.records import HEAD, MESSAGE_HEAD, Gap, Record
from fpt_ros.bags.scan import mapped
from fpt_ros.bags.summary import Chunk, Summary

_INDEX = struct.Struct("<HI")
_CHUNK_HEAD = struct.Struct("<QQQII4sQ")


class Left:
    """One file as it was left, and its side file.

    Attributes:
        size: bytes up to which it is whole, without its end.
        crc: of these bytes.
        summary: of what they hold.
        stamps: of the messages of each channel [ns], chunk by chunk.
        attachments: the latest of each name.
        metadata: the latest record of each name.
        announcements: schemas and channels of the side file, as bytes.
        aside: channel, stamp and bytes of each message that is in the side file alone.
    """

    def __init__(self, path: Path) -> None:
        """Raises BadInput: it cannot be read."""
        self.path = path
        self._data = mapped(path)
        self.size = 0
        self.summary = Summary()
        self.stamps: dict[int, list[NDArray[np.int64]]] = {}
        self.attachments: dict[str, bytes] = {}
        self.metadata: dict[str, dict[str, str]] = {}
        self.announcements = b""
        self.aside: list[tuple[int, int, bytes]] = []
        self._ended = False
        self._walk()
        self._check_last_chunk()
        self.crc = zlib.crc32(self._data[: self.size])
        self._read_side_file()

    def _walk(self) -> None:
        for step in records.walk(self._data):
            if isinstance(step, Gap):
                return
            body = self._data[step.at : step.end]
            if step.opcode in (records.SCHEMA, records.CHANNEL):
                self._announce(step.opcode, body)
            self._ended = self._ended or step.opcode in (records.DATA_END, 0)
            if self._ended:
                continue
            if step.opcode == records.CHUNK:
                self._chunk(step)
            elif step.opcode == records.MESSAGE_INDEX:
                self._index(step)
            elif step.opcode == records.ATTACHMENT:
                attachment = Attachment.read(ReadDataStream(BytesIO(body)))
                self.attachments[attachment.name] = attachment.data
                self.summary.attachment(attachment, step.start, step.end - step.start)
            elif step.opcode == records.METADATA:
                metadata = Metadata.read(ReadDataStream(BytesIO(body)))
                self.metadata[metadata.name] = metadata.metadata
                self.summary.metadata(metadata.name, step.start, step.end - step.start)
            self.size = step.end

    def _announce(self, opcode: int, body: memoryview) -> None:
        """A topic, as the side file or the end of the file names it."""
        stream = ReadDataStream(BytesIO(body))
        if opcode == records.SCHEMA:
            schema = Schema.read(stream)
            if schema.id not in [each.id for each in self.summary.schemas]:
                self.summary.schemas.append(schema)
            return
        channel = Channel.read(stream)
        if channel.id not in [each.id for each in self.summary.channels]:
            self.summary.channels.append(channel)

    def _chunk(self, step: Record) -> None:
        first, last, size, _, _, _, packed = _CHUNK_HEAD.unpack_from(self._data, step.at)
        length = step.end - step.start
        self.summary.chunks.append(Chunk(step.start, length, {}, 0, packed, size, first, last))

    def _index(self, step: Record) -> None:
        """Where the messages of one channel lie in the chunk in front."""
        last = self.summary.chunks[-1]
        channel, length = _INDEX.unpack_from(self._data, step.at)
        rows = np.frombuffer(self._data, np.int64, length // 8, step.at + _INDEX.size)
        self.stamps.setdefault(channel, []).append(rows[::2].copy())
        self.summary.chunks[-1] = last._replace(
            index_offsets={**last.index_offsets, channel: step.start},
            index_length=last.index_length + step.end - step.start,
        )

    def _check_last_chunk(self) -> None:
        """Leave it out where its writer did not come to the end of it: the side file has it all."""
        if self._ended or not self.summary.chunks:
            return
        last = self.summary.chunks[-1]
        if last.start + last.length + last.index_length != self.size:
            return  # something follows
        try:
            body = self._data[last.start + HEAD.size : last.start + last.length]
            _, rows = chunk.split(chunk.unpack(body), True)
            found = {channel: len(flat) // 4 for channel, flat in rows.items()}
        except BadChunk:
            found = {}
        indexed = {channel: len(self.stamps[channel][-1]) for channel in last.index_offsets}
        if found == indexed:
            return
        for channel in indexed:
            self.stamps[channel].pop()
        self.summary.chunks.pop()
        self.size = last.start

    def _read_side_file(self) -> None:
        path = self.path.with_name(self.path.name + SIDE)
        if not path.is_file():
            return
        data = memoryview(path.read_bytes())
        for step in records.walk(data):
            if isinstance(step, Gap):
                return
            if step.opcode in (records.SCHEMA, records.CHANNEL):
                self._announce(step.opcode, data[step.at : step.end])
                self.announcements += bytes(data[step.start : step.end])
            elif step.opcode == records.MESSAGE:
                channel, sequence, stamp, _ = MESSAGE_HEAD.unpack_from(data, step.at)
                content = bytes(data[step.at + MESSAGE_HEAD.size : step.end])
                if sequence >= self.count(channel):
                    self.aside.append((channel, stamp, content))

    def count(self, channel: int) -> int:
        """Messages in the file itself."""
        return sum(map(len, self.stamps.get(channel, ())))

    def stamps_of(self, channel: int) -> list[int]:
        """Of all its messages [ns]."""
        found = [stamp for each in self.stamps.get(channel, ()) for stamp in each.tolist()]
        return found + [stamp for which, stamp, _ in self.aside if which == channel]
