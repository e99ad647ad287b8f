"""Where two messages first differ."""

import math

from fpt_ros.messages.frames import JointStates
from fpt_ros.messages.topics import JOINT_STATES
from fpt_ros.replay.compared import first_field


def test_the_first_field() -> None:
    a = JointStates(7, ("q1", "q2"), (1.0, 2.0), (math.nan, 0.0), ())
    assert first_field(JOINT_STATES, a, a._replace(velocity=(math.nan, 0.0))) is None
    assert first_field(JOINT_STATES, a, a._replace(velocity=(math.nan, -0.0))) == (
        "velocity.q2",
        0.0,
        -0.0,
    )
    assert first_field(JOINT_STATES, a, a._replace(names=("q2", "q1"))) == (
        "names",
        "q1, q2",
        "q2, q1",
    )
    assert first_field(JOINT_STATES, a, a._replace(effort=(1.0, 2.0))) == (
        "effort",
        "0 numbers",
        "2 numbers",
    )
    assert first_field(JOINT_STATES, None, a) == ("header.stamp", None, 7e-9)
