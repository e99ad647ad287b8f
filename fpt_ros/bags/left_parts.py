"""The files of a recording whose writer was killed."""

from pathlib import Path

from fpt_ros.bags import parameter_text
from fpt_ros.bags.bag import INFO
from fpt_ros.bags.files import METADATA, SIDE
from fpt_ros.bags.left import Left
from fpt_ros.bags.metadata import Part, TopicPart
from fpt_ros.yaml_text import parse


def parts_left(directory: Path) -> list[Left]:
    """All files in their order; one that was only just begun is removed.

    Empty: nothing was recorded, and the directory is not there any more.
    """
    found: list[Left] = []
    while (path := directory / f"{directory.name}_{len(found)}.mcap").is_file():
        left = Left(path)
        if INFO not in left.metadata or parameter_text.NAME not in left.attachments:
            path.unlink()
            path.with_name(path.name + SIDE).unlink(missing_ok=True)
            break
        found.append(left)
    if not found and directory.is_dir():
        directory.rmdir()
    (directory / METADATA).unlink(missing_ok=True)
    return found


def part(left: Left) -> Part:
    """What metadata.yaml says of the file."""
    types = {each.id: each.name for each in left.summary.schemas}
    topics = {
        each.topic: TopicPart(
            types[each.schema_id],
            parse(each.metadata["offered_qos_profiles"]),
            each.metadata["topic_type_hash"],
            left.count(each.id),
        )
        for each in left.summary.channels
    }
    chunks = left.summary.chunks
    first = min((each.first for each in chunks), default=0)
    return Part(left.path.name, first, max((each.last for each in chunks), default=0), topics)
