"""Messages and comparisons for the tests of recordings."""

from fpt_ros.messages.cdr import Codec
from fpt_ros.messages.frames import JointStates
from fpt_ros.messages.topics import JOINT_STATES
from fpt_ros.runs.run import Series

CODEC = Codec(JOINT_STATES)


def same(a: Series, b: Series, count: int | None = None) -> None:
    assert a.names == b.names
    assert a.stamps.tobytes() == b.stamps[:count].tobytes()
    for name, numbers in a.vectors.items():
        assert numbers.tobytes() == b.vectors[name][:count].tobytes()


def message(stamp: int, value: float = 1.0) -> bytes:
    return CODEC.encode(JointStates(stamp, ("q1",), (value,), (value,), (value,)))
