"""Names of a message's numbers: by joint where the message names its joints, else by place."""

import re
from collections.abc import Iterator
from typing import NamedTuple

from fpt_ros.bags.layout import Layout
from fpt_ros.bags.numbers import Part, Reading

JOINTS = ("name", "names", "joint_name", "joint_names")
"""Fields of words that name the elements of the arrays beside them."""

_ELEMENT = re.compile(r"^(.*)\[(\d+)\]$")


class Column(NamedTuple):
    """One number of a message.

    Attributes:
        name: as in ``position.elbow``, ``position[2]`` or ``header.stamp.sec``.
        path: of the field that holds it.
        element: its place in there.
        joint: whose it is; empty: the message does not say.
    """

    name: str
    path: str
    element: int
    joint: str


def joints(layout: Layout) -> tuple[str, ...]:
    """The joints that a message names; empty: none, or one twice."""
    for field in JOINTS:
        prefix = f"{field}["
        found = tuple(text for path, text in layout.texts.items() if path.startswith(prefix))
        if found and len(set(found)) == len(found):
            return found
    return ()


def columns(part: Part) -> Iterator[Column]:
    """The numbers of a part's messages, in the order in which they are serialised."""
    names = joints(part.layout)
    for leaf in part.layout.leaves:
        if leaf.path not in part.numbers:
            continue
        if leaf.length is None:
            yield Column(leaf.path, leaf.path, 0, "")
        elif names and leaf.length == len(names):
            for i, name in enumerate(names):
                yield Column(f"{leaf.path}.{name}", leaf.path, i, name)
        else:
            for i in range(leaf.length):
                yield Column(f"{leaf.path}[{i}]", leaf.path, i, "")


def all_names(reading: Reading) -> list[str]:
    """The columns of a topic, each once, in the order in which they are met."""
    parts = sorted(reading.parts, key=lambda part: int(part.at.min()))
    return list(dict.fromkeys(column.name for part in parts for column in columns(part)))


def split_element(field: str) -> tuple[str, int | None]:
    """``position[2]`` as ``position`` and 2."""
    found = _ELEMENT.match(field)
    return (found[1], int(found[2])) if found else (field, None)
