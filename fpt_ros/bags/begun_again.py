"""The topic on which the plant tells that its run begins again: the stamp of its first cycle."""

import struct

from fpt_ros.errors import BadInput
from fpt_ros.messages.frames import SECOND

TOPIC, TYPE = "begun_again", "builtin_interfaces/msg/Time"

_LAYOUT = struct.Struct("<4xiI")


def stamp(data: bytes) -> int:
    """Of a message of :data:`TOPIC` [ns].

    Raises:
        BadInput: it is something else.
    """
    if len(data) < _LAYOUT.size:
        raise BadInput(f"the message is not a {TYPE}")
    seconds, nanoseconds = _LAYOUT.unpack_from(data)
    return int(seconds) * SECOND + int(nanoseconds)


def text(stamps: list[int]) -> str:
    """As ``info`` has them: seconds, one after the other."""
    return ", ".join(f"{each / SECOND:.9g} s" for each in stamps)
