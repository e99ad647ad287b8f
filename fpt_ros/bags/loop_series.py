"""The topics of a recorded loop as series: one number a name."""

import numpy as np
from numpy.typing import NDArray

from fpt_ros.bags.block import Source
from fpt_ros.bags.numbers import Part, Reading
from fpt_ros.messages.frames import SECOND, Names
from fpt_ros.messages.topics import BY_NAME, JOINT_STATE, JOINT_TRAJECTORY, Topic
from fpt_ros.runs.run import Series


def loop_topic(source: Source) -> Topic | None:
    """The topic of the loop that it is, in whatever namespace; ``None``: another one."""
    topic = BY_NAME.get(source.topic.rpartition("/")[2])
    return topic if topic is not None and source.type == topic.type else None


def series(topic: Topic, reading: Reading) -> tuple[Series, int]:
    """The frames of a topic, and how many messages are none: not one number a name.

    A vector that a sender left empty (``velocity`` of a JointState) is NaN; where it has no stamp,
    that of the recorder counts.
    """
    usable, bad = [], reading.bad
    for part in reading.parts:
        names = _names(topic, part)
        if names is None:
            bad += len(part.at)
        else:
            usable.append((part, names))
    names = tuple(dict.fromkeys(name for _, own in _by_first(usable) for name in own))
    places = {name: i for i, name in enumerate(names)}
    count = len(reading.stamps)
    used = np.zeros(count, dtype=bool)
    stamps = np.zeros(count, dtype=np.int64)
    vectors = {key: np.full((count, len(names)), np.nan) for key in topic.vectors}
    for part, own in usable:
        used[part.at] = True
        sent = _stamps(part)
        stamps[part.at] = np.where(sent == 0, reading.stamps[part.at], sent)
        columns = np.array([places[name] for name in own], dtype=np.int64)
        for key, path in zip(topic.vectors, _paths(topic), strict=True):
            if _width(part, path):
                vectors[key][np.ix_(part.at, columns)] = part.numbers[path]
    if not used.all():
        stamps = stamps[used]
        vectors = {key: matrix[used] for key, matrix in vectors.items()}
    return Series(stamps, names, vectors), bad


def _by_first(usable: list[tuple[Part, Names]]) -> list[tuple[Part, Names]]:
    return sorted(usable, key=lambda pair: int(pair[0].at.min()))


def _width(part: Part, path: str) -> int:
    return int(part.numbers[path].shape[1]) if path in part.numbers else 0


def _stamps(part: Part) -> NDArray[np.int64]:
    seconds = part.numbers["header.stamp.sec"][:, 0].astype(np.int64)
    return seconds * SECOND + part.numbers["header.stamp.nanosec"][:, 0].astype(np.int64)


def _paths(topic: Topic) -> list[str]:
    prefix = "points[0]." if topic.type == JOINT_TRAJECTORY else ""
    return [f"{prefix}{field}" for field in topic.fields]


def _names(topic: Topic, part: Part) -> Names | None:
    """Names of the frames; ``None``: they are none."""
    field = "joint_names" if topic.type == JOINT_TRAJECTORY else "name"
    names = tuple(text for path, text in part.layout.texts.items() if path.startswith(f"{field}["))
    widths = [_width(part, path) for path in _paths(topic)]
    optional = 0 if topic.type == JOINT_STATE else len(names)
    fits = widths[0] == len(names) and set(widths) <= {len(names), optional}
    return names if fits and "points[1].positions" not in part.numbers else None
