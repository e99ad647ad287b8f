"""Writing a recording: a rosbag2 directory that says by itself what ran."""

import contextlib
from collections.abc import Iterator, Mapping
from pathlib import Path
from time import monotonic
from types import TracebackType
from typing import NamedTuple, Self

from fpt_ros import __version__
from fpt_ros.bags import parameter_text
from fpt_ros.bags.bag import END
from fpt_ros.bags.mcap_file import McapFile
from fpt_ros.bags.schemas import Schema, offered_qos, schema, yaml_text
from fpt_ros.errors import BadInput, RunFailed
from fpt_ros.parameters import Values

INFO = "fpt_ros"
"""Metadata record in front: what the run is."""

FLUSH_PERIOD = 1.0
"""Messages are this old [s] at most, by the wall clock, when they go to the file."""


class _Topic(NamedTuple):
    channel: int
    schema: Schema
    qos: list[dict[str, object]]


class BagWriter:
    """Records one run. Its directory is ``NAME/NAME_0.mcap`` and ``NAME/metadata.yaml``.

    The file is whole after every chunk: a process that is killed loses what it wrote in the last
    second at most. Not shared between threads.
    """

    def __init__(
        self, directory: Path, parameters: Mapping[str, Values], info: Mapping[str, str]
    ) -> None:
        """Create the directory, and put what is known at the start in front of the file.

        Args:
            directory: must not exist; its parents are created.
            parameters: complete, of every node.
            info: experiment, variant, engine, version, namespace, ...

        Raises:
            BadInput: the directory exists or cannot be created.
        """
        self.directory = directory
        self.path = directory / f"{directory.name}_0.mcap"
        self.closed = False
        self._info = dict(info)
        self._topics: dict[str, _Topic] = {}
        text = parameter_text.to_text(parameters)
        _make(directory)
        try:
            self._file = McapFile(self.path, "ros2", f"fpt_ros {__version__}")
        except OSError as error:
            directory.rmdir()
            raise BadInput(f"{self.path} cannot be created: {error.strerror}") from error
        with self._writing(self.path):
            self._file.attach(parameter_text.NAME, "application/yaml", text.encode())
            self._file.metadata(INFO, self._info)
        self._flushed = monotonic()

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
        about, qos = schema(type), offered_qos(topic, depth)
        # rosbags compares this text with metadata.yaml, and finds no messages if they differ
        metadata = {"offered_qos_profiles": yaml_text(qos), "topic_type_hash": about.hash}
        with self._writing(self.path):
            channel = self._file.add_channel(topic, type, about.text, metadata)
        self._topics[topic] = _Topic(channel, about, qos)

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
            raise RunFailed(f"{self.path} is closed: nothing more can be recorded")
        if topic not in self._topics:
            self.add_topic(topic, type)
        try:
            self._file.message(self._topics[topic].channel, stamp, data)
        except OSError as error:
            raise self._failed(self.path, error) from error
        if monotonic() - self._flushed > FLUSH_PERIOD:
            self.flush()

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
            self._file.flush()
            counts = self._counts()
            if not self._file.finished:
                messages = {f"messages {topic}": str(count) for topic, count in counts.items()}
                self._file.metadata(END, {**end, **messages})
            self._file.finish()
        path = self.directory / "metadata.yaml"
        part = path.with_suffix(".yaml.part")
        with self._writing(path):
            part.write_text(yaml_text(self._metadata(counts, end)), encoding="utf-8")
            part.replace(path)
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
            self.close()
            return
        reason = "interrupted" if isinstance(error, KeyboardInterrupt) else str(error)
        # what ended the run matters more than what then happens to its recording
        with contextlib.suppress(RunFailed):
            self.close(reason or type(error).__name__)

    def _counts(self) -> dict[str, int]:
        counts = self._file.counts
        return {topic: counts.get(known.channel, 0) for topic, known in self._topics.items()}

    def _metadata(self, counts: Mapping[str, int], end: Mapping[str, str]) -> dict[str, object]:
        """``metadata.yaml`` of rosbag2, version 9."""
        first, last = self._file.span
        span = {
            "duration": {"nanoseconds": last - first},
            "starting_time": {"nanoseconds_since_epoch": first},
            "message_count": sum(counts.values()),
        }
        topics = [
            {
                "topic_metadata": {
                    "name": topic,
                    "type": known.schema.type,
                    "serialization_format": "cdr",
                    "offered_qos_profiles": known.qos,
                    "type_description_hash": known.schema.hash,
                },
                "message_count": counts[topic],
            }
            for topic, known in self._topics.items()
        ]
        content = {
            "version": 9,
            "storage_identifier": "mcap",
            **span,
            "topics_with_message_count": topics,
            "compression_format": "",
            "compression_mode": "",
            "relative_file_paths": [self.path.name],
            "files": [{"path": self.path.name, **span}],
            "custom_data": {**self._info, **end},
            "ros_distro": "jazzy",
        }
        return {"rosbag2_bagfile_information": content}

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
