"""Writing the messages of a recording again, in one file: byte for byte, with all that is known."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from ruamel.yaml.error import YAMLError

from fpt_ros import __version__
from fpt_ros.bags import definitions, parameter_text, schemas
from fpt_ros.bags.bag import COUNT, END, INFO, Bag
from fpt_ros.bags.block import Kind, Source
from fpt_ros.bags.mcap_file import McapFile
from fpt_ros.bags.metadata import Part, TopicPart
from fpt_ros.errors import BadInput
from fpt_ros.yaml_text import parse

_OURS = Kind("cdr", "", b"", {})
"""A topic that the bag does not have."""


class Copy:
    """Writes the messages of a bag to one file."""

    def __init__(
        self, bag: Bag, path: Path, wanted: Callable[[Source], bool] = lambda source: True
    ) -> None:
        """``wanted``: the topics of the bag that are written."""
        self._bag, self._wanted = bag, wanted
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
        """One message, of a topic of the bag or of another one of a type of Jazzy."""
        if source not in self._topics:
            self._announce(source)
        self._file.message(self._topics[source][0], stamp, data)

    def finish(self) -> dict[str, str]:
        """End the file; gives what metadata.yaml says of the run."""
        self.begin()
        for source in self._bag.kinds:
            if source not in self._topics and self._wanted(source):
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
        kind = self._bag.kinds.get(source, _OURS)
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
        found = parse(text) if text else None
    except (YAMLError, ValueError):
        found = None
    good = isinstance(found, list) and found and isinstance(found[0].get("history"), str)
    return found if good else schemas.offered_qos(topic)
