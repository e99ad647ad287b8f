"""A recording, whoever made it: its messages as far as they are whole, and what is missing."""

import tempfile
from collections import Counter
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import zstandard

from fpt_ros.bags import files
from fpt_ros.bags.block import Block, Item, Kind, Rows, Source
from fpt_ros.bags.records import MAGIC
from fpt_ros.bags.scan import CUT, DAMAGED, Scan, mapped
from fpt_ros.bags.sqlite_file import MAGIC as SQLITE
from fpt_ros.bags.sqlite_file import SqliteScan
from fpt_ros.errors import BadInput

INFO = "fpt_ros"
"""Metadata record in front of our own recordings: what the run is."""

END = "fpt_ros.end"
"""Metadata record behind the messages of our own recordings: how the run ended."""

NEXT = "next"
"""Key of :data:`END`: the file in which the recording goes on."""

COUNT = "messages "
"""Begins the keys of :data:`END` that count the messages of a topic in the file."""

_ZSTD = b"\x28\xb5\x2f\xfd"


class Bag:
    """All files of a recording as one stream of messages.

    A damaged one is read as far as it goes; :attr:`missing` then says what is not there. All
    attributes are complete when :meth:`blocks` is through.

    Attributes:
        path: as it was given.
        files: that are read, in order.
        kinds: of the topics, with or without messages.
        counts: messages read.
        attachments, metadata: by name, of our own recordings.
        missing: what is damaged or not there, a line each; empty for a whole recording.
        notes: what a reader should know, and that loses nothing.
    """

    def __init__(self, path: Path) -> None:
        """Raises BadInput: it is not there, or not a recording."""
        self.path = path
        found = files.find(path)
        self.files, self.notes = found.paths, found.notes
        self.missing = list(found.missing)
        self.kinds: dict[Source, Kind] = {}
        self.counts: Counter[Source] = Counter()
        self.attachments: dict[str, bytes] = {}
        self.metadata: dict[str, Mapping[str, str]] = {}
        self._expected: Counter[str] = Counter()
        self._about = found.metadata
        self._cut = False

    def messages(self) -> Iterator[Item]:
        """Every message, in the order in which they were written."""
        for block in self.blocks():
            yield from block.items()

    def blocks(self) -> Iterator[Block]:
        """Every message, many at a time.

        Raises:
            BadInput: a file is not one of a recording.
        """
        for path in self.files:
            for block in self._file(path):
                for source, rows in block.rows.items():
                    self.counts[source] += len(rows)
                yield block
        self._count()

    @property
    def reason(self) -> str:
        """Why the recording is not whole, in a few words; empty: it is."""
        if not self.missing:
            return ""
        return CUT if self._cut else DAMAGED

    def _file(self, path: Path) -> Iterator[Block]:
        with _plain(path, self.missing) as plain:
            data = mapped(plain)
            if data[: len(SQLITE)] == SQLITE:
                yield from self._through(SqliteScan(plain, path.name))
            else:
                _check_mcap(path, data)
                yield from self._mcap(path, data)

    def _mcap(self, path: Path, data: memoryview) -> Iterator[Block]:
        scan = Scan(path, data)
        yield from self._through(scan)
        side = path.with_name(path.name + files.SIDE)
        if side.is_file():
            aside = Scan(side, memoryview(side.read_bytes()))
            for block in aside.blocks():
                self.kinds = {**aside.kinds, **self.kinds}  # known before their messages are
                yield _without(block, aside, scan.sequences)
            self.kinds = {**aside.kinds, **self.kinds}
        end = scan.metadata.get(END, {})
        self._check_following(path, end.get(NEXT, ""))
        own: Counter[str] = Counter()
        for channel, count in scan.counts.items():
            if channel in scan.sources:
                own[scan.sources[channel].topic] += count
        for key, text in end.items():
            if key.startswith(COUNT) and text.isdigit():
                topic = key.removeprefix(COUNT)
                own[topic] = max(int(text), own[topic])
        self._expected.update(own)

    def _check_following(self, path: Path, following: str) -> None:
        """Whether the file in which this one goes on is there: it may be lost, or never begun."""
        if not following or self._about or self.path in self.files:
            return  # its folder's metadata.yaml names all, and of a single file nobody asks
        known = [*(each.name for each in self.files), *self.missing]  # a gap is told already
        if not any(each.startswith(following) for each in known):  # .mcap.zstd too
            self.missing.append(f"{following}, in which {path.name} goes on, is not there")
            self._cut = True

    def _through(self, scan: Scan | SqliteScan) -> Iterator[Block]:
        for block in scan.blocks():
            self._learn(scan)
            yield block
        self._learn(scan)
        self.missing += scan.damage
        self._cut = self._cut or scan.cut

    def _learn(self, scan: Scan | SqliteScan) -> None:
        """Take over what the file says of itself so far."""
        self.kinds = {**scan.kinds, **self.kinds}
        if isinstance(scan, Scan):
            self.attachments.update(scan.attachments)
            self.metadata.update(scan.metadata)

    def _count(self) -> None:
        """Compare with what the recording says of itself."""
        expected = dict(self._expected)
        for topic, count in _counted(self._about).items():
            expected[topic] = max(count, expected.get(topic, 0))
        read: Counter[str] = Counter()
        for source, count in self.counts.items():
            read[source.topic] += count
        self.missing += [
            f"{count - read[topic] if read[topic] else 'all'} of {count} messages on {topic} are "
            "missing"
            for topic, count in expected.items()
            if count > read[topic]
        ]


def _counted(about: Mapping[str, Any]) -> dict[str, int]:
    """Messages by topic, as metadata.yaml has them."""
    counts: Counter[str] = Counter()
    try:
        for each in about.get("topics_with_message_count", ()):
            counts[str(each["topic_metadata"]["name"])] += int(each["message_count"])
    except (KeyError, TypeError, ValueError):
        return {}
    return counts


def _without(block: Block, aside: Scan, written: Mapping[int, int]) -> Block:
    """A side file's messages that are not in the file yet."""
    rows: dict[Source, Rows] = {}
    for channel, source in aside.sources.items():
        if source in block.rows:
            own = block.rows[source]
            rows[source] = own[own[:, 3] >= written.get(channel, 0)]
    return Block(block.data, rows)


def _check_mcap(path: Path, data: memoryview) -> None:
    """It begins as an MCAP file, but for some damaged bytes."""
    begin = bytes(data[: len(MAGIC)])
    if sum(a == b for a, b in zip(begin, MAGIC, strict=False)) < len(MAGIC) - 2:
        if bytes(data[:12]) == b"#ROSBAG V2.0":
            raise BadInput(f"{path} is a bag of ROS 1: rosbags-convert makes a recording of it")
        raise BadInput(
            f"{path} is not an MCAP file: it has to be a recording's directory, or its .mcap or "
            ".db3 file"
        )


@contextmanager
def _plain(path: Path, missing: list[str]) -> Iterator[Path]:
    """The file as it is where it is not compressed as a whole."""
    data = mapped(path)
    if data[: len(_ZSTD)] != _ZSTD:
        yield path
        return
    with tempfile.NamedTemporaryFile(prefix="fpt_ros.") as whole:
        try:
            with zstandard.ZstdDecompressor().stream_reader(
                data, read_across_frames=True
            ) as reader:
                while piece := reader.read(1 << 20):
                    whole.write(piece)
            whole.flush()
        except zstandard.ZstdError:
            missing.append(f"{path.name} is compressed, and not whole")
            whole.flush()
        except OSError as error:
            raise BadInput(f"{path} cannot be decompressed: {error.strerror}") from error
        yield Path(whole.name)
