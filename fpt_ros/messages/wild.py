"""Messages that nobody should send on a topic of the loop."""

import math
import random
from collections.abc import Sequence

from fpt_ros.messages.cdr import Codec
from fpt_ros.messages.frames import SECOND, Frame
from fpt_ros.messages.topics import Topic

NUMBERS = {"nan": math.nan, "infinite": math.inf, "huge": 1e300, "plain": 0.25}

FAR = 2_100_000_000 * SECOND
"""The year 2036 [ns]."""


def frame(
    topic: Topic, stamp: int, names: Sequence[str], value: float = 0.25, length: int | None = None
) -> Frame:
    """One number everywhere; ``length``: of the vectors, by default that of the names."""
    count = len(names) if length is None else length
    made: Frame = topic.frame(stamp, tuple(names), *[[value] * count for _ in topic.vectors])
    return made


def kinds(topic: Topic, stamp: int, names: Sequence[str], seed: int = 1) -> dict[str, bytes]:
    """Messages of all kinds for one topic, by what is wrong with them.

    Args:
        topic: of the loop.
        stamp: one that might be due [ns].
        names: joints that the loop knows, two at least.
        seed: of the bytes that are no message.
    """
    encode, chance = Codec(topic).encode, random.Random(seed)
    found = {name: encode(frame(topic, stamp, names, x)) for name, x in NUMBERS.items()}
    found["short"] = encode(frame(topic, stamp, names, length=1))
    found["long"] = encode(frame(topic, stamp, names, length=7))
    found["without numbers"] = encode(frame(topic, stamp, names, length=0))
    found["empty"] = encode(frame(topic, stamp, ()))
    found["unknown joint"] = encode(frame(topic, stamp, ("wheel", "gripper", "q9")))
    found["named twice"] = encode(frame(topic, stamp, (names[0], names[0], names[-1])))
    found["far future"] = encode(frame(topic, FAR, names))
    found["far past"] = encode(frame(topic, 0, names))
    found["before all"] = encode(frame(topic, -5 * SECOND, names))
    for size in (4, 5, 12, 60, 2000):
        found[f"{size} bytes"] = bytes([0, 1, 0, 0]) + chance.randbytes(size - 4)
    whole = encode(frame(topic, stamp, names))
    found["cut"] = whole[: len(whole) // 2]
    found["other endianness"] = bytes([0, 0]) + whole[2:]
    return found
