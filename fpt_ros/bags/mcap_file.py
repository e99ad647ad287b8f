"""One MCAP file on mcap's writer: chunked, compressed, flushed when asked."""

from collections.abc import Mapping
from pathlib import Path

from mcap.writer import CompressionType, Writer

MAGIC = b"\x89MCAP0\r\n"
CHUNK_SIZE = 256 * 1024
"""Bytes of messages that make a chunk full: a tenth of a second of a fast loop."""


class McapFile:
    """Writes one MCAP file. Not shared between threads; every method may raise OSError.

    Attributes:
        counts: messages so far, by channel.
        finished: whether the summary has been written: nothing can be added any more.
    """

    def __init__(self, path: Path, profile: str, library: str) -> None:
        self._stream = path.open("xb")
        self._writer = Writer(self._stream, chunk_size=CHUNK_SIZE, compression=CompressionType.ZSTD)
        self._writer.start(profile, library)
        self._schemas: dict[str, int] = {}
        self.counts: dict[int, int] = {}
        self._span: tuple[int, int] | None = None
        self.finished = False

    def attach(self, name: str, media_type: str, data: bytes) -> None:
        """Add a file of its own, outside the messages."""
        self._writer.add_attachment(0, 0, name, media_type, data)

    def metadata(self, name: str, values: Mapping[str, str]) -> None:
        """Add a record of names and words, behind the messages so far."""
        self.flush()
        self._writer.add_metadata(name, dict(values))

    def add_channel(
        self, topic: str, schema: str, definition: str, metadata: Mapping[str, str]
    ) -> int:
        """Announce a topic of CDR messages; returns its channel."""
        if schema not in self._schemas:
            self._schemas[schema] = self._writer.register_schema(
                schema, "ros2msg", definition.encode()
            )
        channel: int = self._writer.register_channel(
            topic, "cdr", self._schemas[schema], dict(metadata)
        )
        self.counts[channel] = 0
        return channel

    def message(self, channel: int, stamp: int, data: bytes) -> None:
        """Add a message; ``stamp`` [ns] is its log and publish time."""
        sequence = self.counts[channel]
        self._writer.add_message(channel, stamp, data, stamp, sequence)
        self.counts[channel] = sequence + 1
        first, last = self._span or (stamp, stamp)
        self._span = min(first, stamp), max(last, stamp)

    @property
    def span(self) -> tuple[int, int]:
        """First and last stamp [ns]; zeros without messages."""
        return self._span or (0, 0)

    def flush(self) -> None:
        """Hand all messages so far to the operating system, as a chunk."""
        self._writer.flush()

    def finish(self) -> None:
        """Write the summary and close."""
        if not self.finished:
            self._writer.finish()
            self._stream.flush()
            self.finished = True
        self.close()

    def close(self) -> None:
        """Close without a summary: the file then counts as cut."""
        self._stream.close()
