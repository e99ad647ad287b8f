"""Writing a recording: a rosbag2 directory that says by itself what ran."""

import contextlib
from collections.abc import Iterator, Mapping
from pathlib import Path
from time import monotonic
from types import TracebackType
from typing import NamedTuple, Self

from fpt_ros import __version__
from fpt_ros.bags import parameter_text
from fpt_ros.bags.bag import COUNT, END, INFO, NEXT
from fpt_ros.bags.files import METADATA
from fpt_ros.bags.left import Left
from fpt_ros.bags.left_parts import part, parts_left
from fpt_ros.bags.mcap_file import McapFile
from fpt_ros.bags.metadata import Part, TopicPart, write_metadata
from fpt_ros.bags.schemas import Schema, offered_qos, schema, yaml_text
from fpt_ros.bags.split import Split
from fpt_ros.errors import BadInput, RunFailed
from fpt_ros.parameters import Values

NEVER = Split()

FLUSH_PERIOD = 1.0
"""Messages are this old [s] at most, by the wall clock, when they go to the file."""


_NAMES = "ros2", f"fpt_ros {__version__}"
"""Profile and library."""


class _Topic(NamedTuple):
    schema: Schema
    qos: object


class BagWriter:
    """Records one run: ``NAME/NAME_0.mcap``, where it is split _1, _2, and ``NAME/metadata.yaml``.

    The file is whole after every chunk: a process that is killed loses what it wrote in the last
    second at most, and with ``aside`` nothing. Not shared between threads.

    Attributes:
        stamps: of what a killed process had recorded, by topic [ns].
        reason: why the run was incomplete, where the context ends without an error; empty: it was
            whole.
    """

    def __init__(
        self,
        directory: Path,
        parameters: Mapping[str, Values],
        info: Mapping[str, str],
        split: Split = NEVER,
        aside: bool = False,
        again: bool = False,
    ) -> None:
        """Create the directory, and put what is known at the start in front of the file.

        Args:
            directory: must not exist; its parents are created.
            parameters: complete, of every node.
            info: experiment, variant, engine, version, namespace, ...
            split: when to go on in another file.
            aside: keep every message in a side file until its chunk is written.
            again: go on with what a killed process has left in the directory, if it did.

        Raises:
            BadInput: the directory exists or cannot be created.
        """
        self.directory = directory
        self.closed, self.reason = False, ""
        self._info, self._split, self._aside = dict(info), split, aside
        self._topics: dict[str, _Topic] = {}
        self._channels: dict[str, int] = {}
        self._parts: list[Part] = []
        self._text = parameter_text.to_text(parameters)
        self.stamps: dict[str, list[int]] = {}
        self._flushed = monotonic()
        if again:
            left = parts_left(directory)
            if left:
                self._go_on_with(left)
                return
        _make(directory)
        try:
            self._file = self._opened()
        except OSError as error:
            with contextlib.suppress(OSError):
                directory.rmdir()
            raise BadInput(f"{self.path} cannot be created: {error.strerror}") from error
        with self._writing(self.path):
            self._begin()

    def _go_on_with(self, parts: list[Left]) -> None:
        """The recording is as if its process had not been killed."""
        for left in parts:
            about = part(left)
            self._parts.append(about)
            self._channels = {each.topic: each.id for each in left.summary.channels}
            for topic, channel in self._channels.items():
                self._topics[topic] = _Topic(
                    schema(about.topics[topic].type), about.topics[topic].qos
                )
                self.stamps.setdefault(topic, []).extend(left.stamps_of(channel))
        self._parts.pop()
        self._info = dict(parts[0].metadata[INFO])
        self._text = parts[-1].attachments[parameter_text.NAME].decode()
        with self._writing(self.path):
            self._file = McapFile.reopened(parts[-1], *_NAMES)

    @property
    def path(self) -> Path:
        """The file that is being written."""
        return self.directory / f"{self.directory.name}_{len(self._parts)}.mcap"

    def set_parameters(self, parameters: Mapping[str, Values]) -> None:
        """Parameters that are known only now, as those of nodes started by hand.

        Readers take these in the place of the ones from the start.

        Raises:
            RunFailed: the file cannot be written, or has been closed.
        """
        self._check_open()
        text = parameter_text.to_text(parameters)
        if text == self._text:
            return
        self._text = text
        with self._writing(self.path):
            self._file.attach(parameter_text.NAME, "application/yaml", text.encode())

    def add_topic(self, topic: str, type: str, depth: int | None = None) -> None:
        """Announce a topic; one that is written without is announced by its first message.

        Args:
            topic: absolute name, with the namespace.
            type: ROS message type, as in ``sensor_msgs/msg/JointState``.
            depth: of the history that its publisher offers [messages].

        Raises:
            BadInput: an unknown type.
            RunFailed: the file cannot be written.
        """
        if topic in self._topics:
            return
        self._topics[topic] = _Topic(schema(type), offered_qos(topic, depth))
        with self._writing(self.path):
            self._announce(topic)

    def write(self, topic: str, type: str, stamp: int, data: bytes) -> None:
        """Record a message.

        Args:
            topic: absolute name, with the namespace.
            type: ROS message type.
            stamp: log time and publish time [ns], not negative.
            data: serialised message (CDR).

        Raises:
            BadInput: an unknown type.
            RunFailed: the file cannot be written, or has been closed.
        """
        if self.closed:
            self._check_open()
        channel = self._channels.get(topic)
        if channel is None:
            self.add_topic(topic, type)
            channel = self._channels[topic]
        file = self._file
        try:
            file.message(channel, stamp, data)
        except OSError as error:
            raise self._failed(self.path, error) from error
        if monotonic() - self._flushed > FLUSH_PERIOD:
            self.flush()
        if self._split is not NEVER and self._split.is_due(file.size, stamp - file.span[0]):
            with self._writing(self.path):
                self._go_on()

    def flush(self) -> None:
        """Hand all messages so far to the operating system; for when the run pauses.

        Raises:
            RunFailed: the file cannot be written.
        """
        if not self.closed:
            with self._writing(self.path):
                self._file.flush()
            self._flushed = monotonic()

    def close(self, reason: str = "") -> None:
        """Close the recording; once it is closed, nothing.

        Args:
            reason: why the run is not complete, empty if it is.

        Raises:
            RunFailed: the files cannot be written.
        """
        if self.closed:
            return
        end = {"complete": "false" if reason else "true", "reason": reason}
        with self._writing(self.path):
            self._end_part(end)
        path = self.directory / METADATA
        with self._writing(path):
            write_metadata(self.directory, self._parts, {**self._info, **end})
        self.closed = True

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if error is None:
            self.close(self.reason)
            return
        reason = "interrupted" if isinstance(error, KeyboardInterrupt) else str(error)
        # what ended the run matters more than what then happens to its recording
        with contextlib.suppress(RunFailed):
            self.close(reason or type(error).__name__)

    def _opened(self) -> McapFile:
        return McapFile(self.path, *_NAMES, self._aside)

    def _begin(self) -> None:
        """What stands in front of a file's messages."""
        self._file.attach(parameter_text.NAME, "application/yaml", self._text.encode())
        self._file.metadata(INFO, self._info)

    def _announce(self, topic: str) -> None:
        about, qos = self._topics[topic]
        # rosbags compares this text with metadata.yaml, and finds no messages if they differ
        metadata = {"offered_qos_profiles": yaml_text(qos), "topic_type_hash": about.hash}
        self._channels[topic] = self._file.add_channel(
            topic, about.type, about.text.encode(), metadata
        )

    def _go_on(self) -> None:
        """In another file, which can be read without this one."""
        following = f"{self.directory.name}_{len(self._parts) + 1}.mcap"
        goes_on = {"complete": "false", "reason": f"it goes on in {following}", NEXT: following}
        self._end_part(goes_on)
        self._file = self._opened()
        self._begin()
        for topic in self._topics:
            self._announce(topic)

    def _end_part(self, end: Mapping[str, str]) -> None:
        file, path = self._file, self.path
        counts = {topic: file.counts[channel] for topic, channel in self._channels.items()}
        if not file.finished:
            messages = {f"{COUNT}{topic}": str(count) for topic, count in counts.items()}
            file.metadata(END, {**end, **messages})
        file.finish()
        topics = {
            topic: TopicPart(about.type, qos, about.hash, counts[topic])
            for topic, (about, qos) in self._topics.items()
        }
        self._parts.append(Part(path.name, *file.span, topics))

    def _check_open(self) -> None:
        if self.closed:
            raise RunFailed(f"{self.path} is closed: nothing more can be recorded")

    @contextlib.contextmanager
    def _writing(self, path: Path) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            raise self._failed(path, error) from error

    def _failed(self, path: Path, error: OSError) -> RunFailed:
        """Give up: what is in the file stays, and reads as cut."""
        self.closed = True
        with contextlib.suppress(OSError):
            self._file.close()
        return RunFailed(f"{path} cannot be written: {error.strerror}")


def _make(directory: Path) -> None:
    try:
        directory.mkdir(parents=True)
    except FileExistsError as error:
        raise BadInput(
            f"{directory} exists: recordings do not overwrite, give the name of a new directory"
        ) from error
    except OSError as error:
        raise BadInput(f"{directory} cannot be created: {error.strerror}") from error
