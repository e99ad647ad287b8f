"""How the recorder tells the plant how far it has come: a stamp on a topic of its own.

The recorder is not in the control loop, and publishers keep only the last messages. So the plant
begins when the recorder has, and does not run more cycles ahead of it than they keep: then nothing
can be lost, neither at the start, while DDS discovers, nor under load.
"""

import struct

from fpt_ros.messages.cdr import MalformedMessage
from fpt_ros.messages.frames import SECOND
from fpt_ros.messages.topics import DEPTH

RECORDED_UNTIL = "recorded_until"
TIME = "builtin_interfaces/msg/Time"

BEGUN = -1
"""In the place of a stamp: the recorder hears the whole loop, nothing is recorded yet [ns]."""

WINDOW = DEPTH * 3 // 4
"""Cycles that the loop may be ahead of the recorder: less than the history that publishers keep."""

_LAYOUT = struct.Struct("<4xiI")


def encode_time(stamp: int) -> bytes:
    """CDR of a builtin_interfaces/Time, from [ns]."""
    data = bytearray(_LAYOUT.pack(*divmod(stamp, SECOND)))
    data[1] = 1
    return bytes(data)


def decode_time(data: bytes) -> int:
    """Stamp [ns] of a builtin_interfaces/Time.

    Raises:
        MalformedMessage: the bytes are too few.
    """
    if len(data) < _LAYOUT.size:
        raise MalformedMessage(f"{RECORDED_UNTIL}: {len(data)} bytes are not a {TIME}")
    seconds, nanoseconds = _LAYOUT.unpack_from(data)
    return int(seconds) * SECOND + int(nanoseconds)
