"""metadata.yaml of rosbag2, version 9."""

from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

from fpt_ros.bags.files import METADATA
from fpt_ros.bags.schemas import yaml_text


class TopicPart(NamedTuple):
    """A topic in one file: its type, quality of service, the type's hash, and its messages."""

    type: str
    qos: object
    hash: str
    messages: int


class Part(NamedTuple):
    """One file: its name, first and last stamp [ns], and its topics."""

    name: str
    first: int
    last: int
    topics: Mapping[str, TopicPart]

    @property
    def total(self) -> int:
        """Messages of all topics."""
        return sum(topic.messages for topic in self.topics.values())


def write_metadata(directory: Path, parts: Sequence[Part], custom: Mapping[str, str]) -> None:
    """Write the file, whole or not at all.

    Args:
        directory: of the recording.
        parts: its files.
        custom: what the recording says of itself.

    Raises:
        OSError: it cannot be written.
    """
    path = directory / METADATA
    part = path.with_suffix(".yaml.part")
    part.write_text(yaml_text(_content(parts, custom)), encoding="utf-8")
    part.replace(path)


def _content(parts: Sequence[Part], custom: Mapping[str, str]) -> dict[str, object]:
    counts: Counter[str] = Counter()
    topics: dict[str, TopicPart] = {}
    for part in parts:
        for topic, about in part.topics.items():
            counts[topic] += about.messages
            topics.setdefault(topic, about)
    filled = [part for part in parts if part.total]
    first = min((part.first for part in filled), default=0)
    last = max((part.last for part in filled), default=0)
    content = {
        "version": 9,
        "storage_identifier": "mcap",
        **_span(first, last, sum(counts.values())),
        "topics_with_message_count": [
            {
                "topic_metadata": {
                    "name": topic,
                    "type": about.type,
                    "serialization_format": "cdr",
                    "offered_qos_profiles": about.qos,
                    "type_description_hash": about.hash,
                },
                "message_count": counts[topic],
            }
            for topic, about in topics.items()
        ],
        "compression_format": "",
        "compression_mode": "",
        "relative_file_paths": [part.name for part in parts],
        "files": [
            {"path": part.name, **_span(part.first, part.last, part.total)} for part in parts
        ],
        "custom_data": dict(custom),
        "ros_distro": "jazzy",
    }
    return {"rosbag2_bagfile_information": content}


def _span(first: int, last: int, count: int) -> dict[str, object]:
    return {
        "duration": {"nanoseconds": last - first},
        "starting_time": {"nanoseconds_since_epoch": first},
        "message_count": count,
    }
