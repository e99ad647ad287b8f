"""The end of an MCAP file: its index and statistics, by which readers find what they look for."""

import struct
import zlib
from collections.abc import Mapping
from typing import Any, NamedTuple

from mcap.data_stream import RecordBuilder
from mcap.opcode import Opcode
from mcap.records import (
    Attachment,
    AttachmentIndex,
    Channel,
    ChunkIndex,
    DataEnd,
    Footer,
    MetadataIndex,
    Schema,
    Statistics,
    SummaryOffset,
)

from fpt_ros.bags.records import MAGIC


class Chunk(NamedTuple):
    """A chunk that has been written: where it lies, and what it holds."""

    start: int
    length: int
    index_offsets: Mapping[int, int]
    index_length: int
    packed: int
    size: int
    first: int
    last: int


class Summary:
    """Gathers what the end of a file will say."""

    def __init__(self) -> None:
        self.schemas: list[Schema] = []
        self.channels: list[Channel] = []
        self.chunks: list[Chunk] = []
        self._attachments: list[AttachmentIndex] = []
        self._metadata: list[MetadataIndex] = []

    def attachment(self, about: Attachment, offset: int, length: int) -> None:
        """An attachment has been written."""
        self._attachments.append(
            AttachmentIndex(
                offset=offset,
                length=length,
                create_time=0,
                log_time=0,
                data_size=len(about.data),
                name=about.name,
                media_type=about.media_type,
            )
        )

    def metadata(self, name: str, offset: int, length: int) -> None:
        """A metadata record has been written."""
        self._metadata.append(MetadataIndex(offset=offset, length=length, name=name))

    def end(
        self, written: int, crc: int, counts: Mapping[int, int], span: tuple[int, int]
    ) -> bytes:
        """All that follows the messages.

        Args:
            written: bytes in front of it.
            crc: of these bytes.
            counts: messages by channel.
            span: first and last stamp [ns].
        """
        statistics = Statistics(
            attachment_count=len(self._attachments),
            channel_count=len(self.channels),
            channel_message_counts={k: count for k, count in counts.items() if count},
            chunk_count=len(self.chunks),
            message_count=sum(counts.values()),
            metadata_count=len(self._metadata),
            message_start_time=span[0],
            message_end_time=span[1],
            schema_count=len(self.schemas),
        )
        groups: list[tuple[Opcode, list[Any]]] = [
            (Opcode.SCHEMA, self.schemas),
            (Opcode.CHANNEL, self.channels),
            (Opcode.STATISTICS, [statistics]),
            (Opcode.CHUNK_INDEX, [_index(chunk) for chunk in self.chunks]),
            (Opcode.ATTACHMENT_INDEX, self._attachments),
            (Opcode.METADATA_INDEX, self._metadata),
        ]
        data_end = _bytes(DataEnd(crc))
        start = written + len(data_end)
        body, offsets = b"", b""
        for opcode, group in groups:
            raw = b"".join(_bytes(each) for each in group)
            offset = SummaryOffset(
                group_opcode=opcode, group_start=start + len(body), group_length=len(raw)
            )
            offsets += _bytes(offset) if raw else b""
            body += raw
        behind = start + len(body)
        head = struct.pack("<BQQQ", Opcode.FOOTER, 20, start, behind)
        footer = Footer(
            summary_start=start,
            summary_offset_start=behind,
            summary_crc=zlib.crc32(body + offsets + head),
        )
        return data_end + body + offsets + _bytes(footer) + MAGIC


def _index(chunk: Chunk) -> ChunkIndex:
    return ChunkIndex(
        chunk_length=chunk.length,
        chunk_start_offset=chunk.start,
        compression="zstd",
        compressed_size=chunk.packed,
        message_end_time=chunk.last,
        message_index_length=chunk.index_length,
        message_index_offsets=dict(chunk.index_offsets),
        message_start_time=chunk.first,
        uncompressed_size=chunk.size,
    )


def _bytes(record: Any) -> bytes:
    builder = RecordBuilder()
    record.write(builder)
    return bytes(builder.end())
