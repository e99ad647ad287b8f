"""Reading MCAP files from front to back, as far as they go.

A reader that starts from the summary at the end finds nothing in a file that was cut. This one
takes record after record until the file ends or is damaged, and says which.
"""

import struct
from collections.abc import Iterator
from io import BytesIO
from pathlib import Path
from typing import NamedTuple

from mcap.data_stream import ReadDataStream
from mcap.exceptions import EndOfFile, McapError, RecordLengthLimitExceeded
from mcap.records import Attachment, Channel, Chunk, Footer, Message, Metadata, Schema
from mcap.stream_reader import CRCValidationError, StreamReader, get_chunk_data_stream
from zstandard import ZstdError

from fpt_ros.bags.mcap_file import MAGIC
from fpt_ros.errors import BadInput

CUT = "the recording was cut"
DAMAGED = "the recording is damaged"

_RECORD = struct.Struct("<BQ")
_MESSAGE = struct.Struct("<HIQQ")


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


class Scan:
    """One pass over a file.

    Attributes:
        attachments: by name, those met so far.
        metadata: records by name, those met so far.
        sources: the topics met so far, with or without messages.
        ending: when the pass is done: empty for a whole file, else what is wrong with it.
    """

    def __init__(self, path: Path) -> None:
        """Raises BadInput: not a readable MCAP file."""
        self.path = path
        self.attachments: dict[str, bytes] = {}
        self.metadata: dict[str, dict[str, str]] = {}
        self.sources: dict[Source, None] = {}
        self.ending = CUT
        self._schemas: dict[int, str] = {}
        self._channels: dict[int, Source] = {}
        try:
            self._size = path.stat().st_size
            with path.open("rb") as stream:
                magic = stream.read(len(MAGIC))
        except OSError as error:
            raise BadInput(f"{path} cannot be read: {error.strerror}") from error
        if magic != MAGIC:
            raise BadInput(f"{path} is not an MCAP file: it has to be a recording's .mcap")

    def messages(self) -> Iterator[Item]:
        """All messages in the order of the file."""
        try:
            with self.path.open("rb") as stream:
                # no length in a file cut or damaged may ask for more memory than the file has bytes
                reader = StreamReader(stream, emit_chunks=True, record_size_limit=self._size)
                for record in reader.records:
                    if isinstance(record, Chunk):
                        yield from self._chunk(record)
                    elif isinstance(record, Message):
                        yield self._item(record.channel_id, record.log_time, record.data)
                    elif isinstance(record, Attachment):
                        self.attachments[record.name] = record.data
                    elif isinstance(record, Metadata):
                        self.metadata[record.name] = record.metadata
                    elif isinstance(record, Schema):
                        self._schemas[record.id] = record.name
                    elif isinstance(record, Channel):
                        self._add(record)
                    elif isinstance(record, Footer):
                        self.ending = ""
        except (EndOfFile, RecordLengthLimitExceeded, struct.error, UnicodeDecodeError):
            # the last record is not whole; StreamReader reads what there is of it, and stumbles
            pass
        except (McapError, ZstdError, CRCValidationError, KeyError, MemoryError, OverflowError):
            self.ending = DAMAGED
        except OSError as error:
            raise BadInput(f"{self.path} cannot be read: {error.strerror}") from error

    def _chunk(self, chunk: Chunk) -> Iterator[Item]:
        stream, size = get_chunk_data_stream(chunk, validate_crc=True)
        data, at = stream.read(size), 0
        while at < size:
            opcode, length = _RECORD.unpack_from(data, at)
            at += _RECORD.size
            if opcode == 5:
                channel, _, stamp, _ = _MESSAGE.unpack_from(data, at)
                yield self._item(channel, stamp, data[at + _MESSAGE.size : at + length])
            elif opcode in (3, 4):
                body = ReadDataStream(BytesIO(data[at : at + length]))
                if opcode == 3:
                    schema = Schema.read(body)
                    self._schemas[schema.id] = schema.name
                else:
                    self._add(Channel.read(body))
            at += length

    def _item(self, channel: int, stamp: int, data: bytes) -> Item:
        return Item(self._channels[channel], stamp, data)

    def _add(self, channel: Channel) -> None:
        source = Source(channel.topic, self._schemas.get(channel.schema_id, ""))
        self._channels[channel.id] = source
        self.sources[source] = None


def files(path: Path) -> list[Path]:
    """The MCAP files of a recording, in order.

    Args:
        path: a recording's directory, or an MCAP file.

    Raises:
        BadInput: there are none.
    """
    if not path.exists():
        raise BadInput(f"{path} does not exist: it has to be a recording's directory or .mcap file")
    if not path.is_dir():
        return [path]
    try:
        # ..._10.mcap behind ..._9.mcap
        found = sorted(path.glob("*.mcap"), key=lambda file: (len(file.name), file.name))
    except OSError as error:
        raise BadInput(f"{path} cannot be read: {error.strerror}") from error
    if not found:
        raise BadInput(f"{path} holds no .mcap file: it has to be a recording's directory")
    return found
