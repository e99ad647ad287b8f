"""The loop's topics: name, ROS type, and where each vector of a frame stands in the message."""

import builtins
from dataclasses import dataclass

from fpt_ros.messages.frames import Command, Desired, Frame, JointStates, StateEstimate, Tuning

JOINT_STATE = "sensor_msgs/msg/JointState"
JOINT_TRAJECTORY = "trajectory_msgs/msg/JointTrajectory"

MESSAGE_FIELDS = {
    JOINT_STATE: ("position", "velocity", "effort"),
    JOINT_TRAJECTORY: ("positions", "velocities", "accelerations", "effort"),
}
"""The float64 arrays of the two message types, in the order in which they are serialised."""


@dataclass(frozen=True)
class Topic:
    """One topic of the loop.

    Attributes:
        name: relative, so that a namespace moves it.
        type: ROS message type.
        frame: the class of its frames.
        fields: message arrays that hold the frame's vectors, in the frame's order.
    """

    name: str
    type: str
    frame: builtins.type[Frame]
    fields: tuple[str, ...]

    @property
    def vectors(self) -> tuple[str, ...]:
        """Names of the frame's vectors."""
        return self.frame._fields[2:]


JOINT_STATES = Topic("joint_states", JOINT_STATE, JointStates, ("position", "velocity", "effort"))
STATE_ESTIMATE = Topic(
    "state_estimate",
    JOINT_TRAJECTORY,
    StateEstimate,
    ("positions", "velocities", "accelerations", "effort"),
)
DESIRED = Topic(
    "desired", JOINT_TRAJECTORY, Desired, ("positions", "velocities", "accelerations", "effort")
)
TUNING = Topic("tuning", JOINT_STATE, Tuning, ("position",))
COMMAND = Topic("command", JOINT_TRAJECTORY, Command, ("accelerations", "effort"))

LOOP_TOPICS = (JOINT_STATES, STATE_ESTIMATE, DESIRED, TUNING, COMMAND)
"""In the order of events within a cycle."""

BY_NAME = {topic.name: topic for topic in LOOP_TOPICS}

DEPTH = 64
"""History of the loop topics. The recorder may be at most this many cycles behind the loop."""
