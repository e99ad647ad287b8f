"""Whether the numbers of a message can be used: who sends them may be anybody."""

import math
from typing import Any, cast

from fpt_ros.errors import BadInput
from fpt_ros.laws import Vector
from fpt_ros.messages.frames import SECOND, Frame
from fpt_ros.messages.topics import (
    COMMAND,
    DESIRED,
    JOINT_STATES,
    LOOP_TOPICS,
    STATE_ESTIMATE,
    TUNING,
    Topic,
)

NUMBERS = {
    JOINT_STATES.name: ("position",),
    STATE_ESTIMATE.name: ("positions", "velocities"),
    DESIRED.name: ("positions", "velocities", "accelerations", "combined_error"),
    TUNING.name: ("values",),
    COMMAND.name: ("effort",),
}
"""The vectors that have to be numbers; in the others NaN stands for what is not known."""

HUGE = 1e15
"""Numbers beyond it are not of a motion: their products leave the range of doubles."""

LATEST = 2_114_380_800 * SECOND  # the end of 2036
"""The last stamp [ns]: messages have 31 bits for its seconds, and what follows on one that is heard
(a safe effort, while nothing else comes) is stamped later."""

PLACES = {
    topic.name: [(2 + i, field in NUMBERS[topic.name]) for i, field in enumerate(topic.vectors)]
    for topic in LOOP_TOPICS
}
"""Of each topic the places of the vectors in its frame, and whether they have to be numbers."""


def check_content(who: str, topic: Topic, frame: Frame, gaps: bool = False) -> None:
    """Raise BadInput, which begins with ``who``, where a number of a frame cannot be used.

    The norm of a vector shows at once that all is well, as it mostly is. An effort may be as large
    as it likes: it is the plant's to say so. ``gaps``: samples may be lost, NaN stands for them.
    """
    if not 0 <= frame[0] <= LATEST:
        raise BadInput(
            f"{who}: the stamp, {frame[0]} ns, is {'less than 0' if frame[0] < 0 else 'after 2036'}"
        )
    names, whole = frame[1], cast(tuple[Any, ...], frame)
    for at, needed in PLACES[topic.name]:
        vector: Vector = whole[at]
        if math.hypot(*vector) < HUGE and len(vector) == len(names):
            continue
        field, limit = frame._fields[at], math.inf if topic is COMMAND else HUGE
        if len(vector) != len(names):
            raise BadInput(f"{who}: {field} holds {len(vector)} numbers for {len(names)} names")
        for name, value in zip(names, vector, strict=True):
            may_lack = not needed or (gaps and topic is JOINT_STATES)
            absent = math.isnan(value) and may_lack
            if not (absent or abs(value) < limit):
                raise BadInput(f"{who}: {field} of {name} is {value:g}, not a usable number")
