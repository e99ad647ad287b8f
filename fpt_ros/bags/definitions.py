"""What the types of a recording's topics look like: as it says itself, or as Jazzy has them."""

from collections.abc import Callable
from functools import cache, lru_cache

from rosbags.interfaces import Nodetype
from rosbags.typesys import Stores, get_types_from_idl, get_types_from_msg, get_typestore

from fpt_ros.bags.block import Kind, Source
from fpt_ros.bags.layout import Definitions
from fpt_ros.errors import BadInput

_PARSERS: dict[str, Callable[[str, str], Definitions]] = {
    "ros2msg": get_types_from_msg,
    "ros2idl": lambda text, name: get_types_from_idl(text),
}


def full_name(type: str) -> str:
    """``package/msg/Name``, where some tools write ``package/Name``."""
    package, slash, name = type.partition("/")
    return f"{package}/msg/{name}" if slash and "/" not in name else type


def of(source: Source, kind: Kind) -> Definitions:
    """Fields by type, of a topic's type and of those that it is made of.

    Raises:
        BadInput: its messages are written in another way, or its type is not known.
    """
    name = full_name(source.type)
    if kind.encoding not in ("cdr", ""):
        raise BadInput(
            f"{source.topic} is written as {kind.encoding}: topics written as cdr and json are read"
        )
    known = _known(source, kind, name)
    lacking = _lacking(name, known)
    if lacking:
        raise BadInput(f"{source.topic}: the recording does not say what a {lacking} is")
    return known


def _lacking(name: str, known: Definitions) -> str:
    """A type that is needed and not known; empty: none."""
    seen, open = set[str](), [name]
    while open:
        type = open.pop()
        if type not in known:
            return type or "message without a type"
        seen.add(type)
        for _, (kind, about) in known[type][1]:
            if kind in (Nodetype.ARRAY, Nodetype.SEQUENCE):
                kind, about = about[0]
            if kind == Nodetype.NAME and about not in seen:
                open.append(about)
    return ""


def _known(source: Source, kind: Kind, name: str) -> Definitions:
    known = _jazzy()
    if kind.definition and kind.form in _PARSERS:
        try:
            return {**known, **_parsed(kind.form, kind.definition.decode(), name)}
        except Exception as error:  # whatever the parsers stumble over
            if name not in known:
                raise BadInput(
                    f"{source.topic}: the definition of {name} cannot be read"
                ) from error
    return known


@lru_cache(maxsize=64)
def _parsed(form: str, text: str, name: str) -> Definitions:
    """Split recordings say the same in each file."""
    return _PARSERS[form](text, name)


@cache
def _jazzy() -> Definitions:
    return get_typestore(Stores.ROS2_JAZZY).fielddefs
