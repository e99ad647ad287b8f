"""Writing what is left of a recording again, so that every reader opens it."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.error import YAMLError

from fpt_ros import __version__
from fpt_ros.bags import definitions, parameter_text, schemas
from fpt_ros.bags.bag import COUNT, END, Bag
from fpt_ros.bags.block import Kind, Source
from fpt_ros.bags.mcap_file import McapFile
from fpt_ros.bags.metadata import Part, TopicPart, write_metadata
from fpt_ros.bags.writer import INFO
from fpt_ros.errors import BadInput, RunFailed

SUFFIX = "-recovered"


@dataclass(frozen=True)
class Recovered:
    """What was written.

    Attributes:
        directory: of the new recording.
        counts: messages by topic.
        missing: what the old one does not hold any more.
    """

    directory: Path
    counts: Mapping[str, int]
    missing: tuple[str, ...]


def recover(
    path: Path, directory: Path | None = None, progress: Callable[[int], None] = lambda done: None
) -> Recovered:
    """Write all that is whole in a recording as a new one; the old one stays as it is.

    Args:
        path: a recording, or one file of it.
        directory: of the new one, must not exist; by default NAME-recovered beside the old one.
        progress: is told how many messages are written.

    Raises:
        BadInput: nothing of it can be read, or the directory exists or cannot be created.
        RunFailed: the new one cannot be written.
    """
    bag = Bag(path)
    stem = path.absolute().name.partition(".")[0] or path.absolute().name
    directory = directory or path.absolute().with_name(stem + SUFFIX)
    part = directory.with_name(directory.name + ".part")
    if directory.exists() or part.exists():
        taken = directory if directory.exists() else part
        raise BadInput(f"{taken} exists: --out takes the name of a new directory")
    try:
        part.mkdir(parents=True)
    except OSError as error:
        raise BadInput(f"{directory} cannot be created: {error.strerror}") from error
    name = f"{directory.name}_0.mcap"
    try:
        writer = _Writer(bag, part / name)
        written = 0
        for block in bag.blocks():
            writer.begin()
            for source, (stamp, start, end, _) in block.ordered():
                writer.message(source, stamp, bytes(block.data[start:end]))
            written += block.total
            progress(written)
        if not written:
            why = "; ".join(bag.missing) or "it has no messages"
            raise BadInput(f"{path}: there is nothing to recover: {why}")
        custom = writer.finish()
        write_metadata(part, [writer.part(name)], custom)
        part.rename(directory)
    except OSError as error:
        _remove(part)
        raise RunFailed(f"{directory} cannot be written: {error.strerror}") from error
    except BaseException:
        _remove(part)
        raise
    return Recovered(directory, writer.counts(), tuple(bag.missing))


def _remove(directory: Path) -> None:
    for each in directory.iterdir():
        each.unlink()
    directory.rmdir()


class _Writer:
    """Writes the messages of a bag to one file."""

    def __init__(self, bag: Bag, path: Path) -> None:
        self._bag = bag
        self._file = McapFile(path, "ros2", f"fpt_ros {__version__}")
        self._topics: dict[Source, tuple[int, TopicPart]] = {}
        self._text: bytes | None = None

    def begin(self) -> None:
        """What stands in front of the messages that follow."""
        text = self._bag.attachments.get(parameter_text.NAME)
        if text is not None and text != self._text:
            self._file.attach(parameter_text.NAME, "application/yaml", text)
            if self._text is None and INFO in self._bag.metadata:
                self._file.metadata(INFO, self._bag.metadata[INFO])
            self._text = text

    def message(self, source: Source, stamp: int, data: bytes) -> None:
        """One message."""
        if source not in self._topics:
            self._announce(source)
        self._file.message(self._topics[source][0], stamp, data)

    def finish(self) -> dict[str, str]:
        """End the file; gives what metadata.yaml says of the run."""
        self.begin()
        for source in self._bag.kinds:
            if source not in self._topics:
                self._announce(source)
        about = dict(self._bag.metadata.get(INFO, {}))
        end = {}
        if about:
            given = self._bag.metadata.get(END, {})
            reason = given.get("reason", "") if given else ""
            end = {
                "complete": "true" if given.get("complete") == "true" else "false",
                "reason": reason,
            }
            if self._bag.missing:
                whole = "; ".join(self._bag.missing)
                end = {"complete": "false", "reason": f"{self._bag.reason}: {whole}"}
            counts = {f"{COUNT}{topic}": str(count) for topic, count in self.counts().items()}
            self._file.metadata(END, {**end, **counts})
        self._file.finish()
        return {**about, **end}

    def counts(self) -> dict[str, int]:
        """Messages by topic."""
        found: dict[str, int] = {}
        for source, (channel, _) in self._topics.items():
            found[source.topic] = found.get(source.topic, 0) + self._file.counts[channel]
        return found

    def part(self, name: str) -> Part:
        """The file, for metadata.yaml."""
        topics = {
            source.topic: about._replace(messages=self.counts()[source.topic])
            for source, (_, about) in self._topics.items()
        }
        return Part(name, *self._file.span, topics)

    def _announce(self, source: Source) -> None:
        kind = self._bag.kinds[source]
        type = definitions.full_name(source.type)
        definition, form, hash = _definition(type, kind)
        qos = _qos(source.topic, kind)
        metadata = {"offered_qos_profiles": schemas.yaml_text(qos), "topic_type_hash": hash}
        channel = self._file.add_channel(
            source.topic, type, definition, metadata, form, kind.encoding or "cdr"
        )
        self._topics[source] = channel, TopicPart(type, qos, hash, 0)


def _definition(type: str, kind: Kind) -> tuple[bytes, str, str]:
    """Text, form and hash of a type."""
    hash = kind.metadata.get("topic_type_hash", "")
    if kind.definition:
        return kind.definition, kind.form, hash
    try:
        known = schemas.schema(type)
    except BadInput:
        return b"", kind.form or "ros2msg", hash
    return known.text.encode(), "ros2msg", known.hash


def _qos(topic: str, kind: Kind) -> Any:
    """Quality of service as the recording has it, or as our topics offer it."""
    text = kind.metadata.get("offered_qos_profiles", "")
    try:
        found = YAML(typ="safe", pure=True).load(text) if text else None
    except (YAMLError, ValueError):
        found = None
    good = isinstance(found, list) and found and isinstance(found[0].get("history"), str)
    return found if good else schemas.offered_qos(topic)
