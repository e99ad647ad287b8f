"""The nominal motion from a topic that anybody publishes (:mod:`fpt_ros.trajectories.live`)."""

from collections.abc import Sequence
from typing import Any

from rclpy.parameter import Parameter as RosParameter
from rclpy.qos import QoSProfile, ReliabilityPolicy
from sensor_msgs.msg import JointState
from trajectory_msgs.msg import JointTrajectory

from fpt_ros.errors import BadInput
from fpt_ros.messages.frames import SECOND
from fpt_ros.nodes.stage_node import StageNode
from fpt_ros.trajectories.live import ACCELERATIONS, NUMBER, POSITIONS, VELOCITIES

KINDS = {"JointTrajectory": JointTrajectory, "JointState": JointState}

Point = tuple[Sequence[float], Sequence[float], Sequence[float]]
"""Positions, velocities, accelerations; one that is not told is empty."""


class LiveMotion:
    """Takes the messages of a topic into the parameters of a trajectory generator's node.

    The newest message counts; of several in a cycle the others are not used. It may have its joints
    in any order, and more of them. Where it is silent for ``hold_after``, in the loop's time, that
    is told once, and once more that it is back.
    """

    def __init__(self, node: StageNode) -> None:
        self._node = node
        values = node.stage.values
        self._topic = str(values["topic"])
        self._number = int(node.get_parameter(NUMBER).value)  # what is pending too
        self._heard_at = -1
        self._silent = False
        newest = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
        kind = KINDS[str(values["message"])]
        node.create_subscription(kind, self._topic, self._on_message, newest)

    def _on_message(self, message: Any) -> None:
        try:
            point = self._point(message)
            self._number += 1
            parameters = [RosParameter(NUMBER, value=self._number)] + [
                RosParameter(name, value=[float(x) for x in numbers])
                for name, numbers in zip((POSITIONS, VELOCITIES, ACCELERATIONS), point, strict=True)
            ]
            result = self._node.set_parameters_atomically(parameters)
            if not result.successful:
                raise BadInput(f"{self._topic}: {result.reason}")
        except BadInput as error:
            self._node.ignore(str(error))
            return
        self._heard_at = self._now()

    def _point(self, message: Any) -> Point:
        """The point of a message, of the controlled joints, zeros where something is not told.

        Raises:
            BadInput: a joint is absent, or the message is not one point.
        """
        if isinstance(message, JointTrajectory):
            names = list(message.joint_names)
            if len(message.points) != 1:
                raise BadInput(f"{self._topic}: {len(message.points)} points, it takes one")
            (only,) = message.points
            told = {"positions": only.positions, "velocities": only.velocities,
                    "accelerations": only.accelerations}  # fmt: skip
        else:
            names = list(message.name)
            told = {"positions": message.position, "velocities": message.velocity,
                    "accelerations": ()}  # fmt: skip
        for what, numbers in told.items():
            if len(numbers) not in (0, len(names)) or (what == "positions" and not len(numbers)):
                raise BadInput(f"{self._topic}: {len(numbers)} {what} of {len(names)} joints")
        wanted = self._node.stage.controlled
        for name in wanted:
            if name not in names:
                raise BadInput(
                    f"{self._topic}: no joint '{name}' among {', '.join(names) or 'none'}"
                )
        where = [names.index(name) for name in wanted]
        chosen = [
            [numbers[i] for i in where] if len(numbers) else [0.0] * len(where)
            for numbers in told.values()
        ]
        return chosen[0], chosen[1], chosen[2]

    def _now(self) -> int:
        """Stamp [ns] of the latest cycle."""
        return int(self._node.stage.clock[1])

    def look_whether_silent(self) -> None:
        """Tell where nothing comes, or where it comes again."""
        now, longest = self._now(), float(self._node.stage.values["hold_after"])
        since = max(self._heard_at, int(self._node.stage.clock[0]))
        silent = now >= 0 and now - since > longest * SECOND
        if silent and not self._silent:
            missing = "nobody publishes" if self._heard_at < 0 else f"nothing for {longest:g} s on"
            self._node.get_logger().warning(
                f"{missing} {self._topic}: the motion rests where it is, until a message comes"
            )
        elif self._silent and not silent:
            self._node.get_logger().info(f"{self._topic} is back")
        self._silent = silent

    def report(self) -> dict[str, object]:
        """For /diagnostics."""
        return {"motion": "at rest, nothing comes" if self._silent else "followed",
                "messages of the motion": self._number}  # fmt: skip
