"""Somebody who is in the same ROS domain as a graph and has no business there: for ``fpt soak``."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from time import monotonic
from typing import Any

import rclpy
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.publisher import Publisher
from rclpy.qos import HistoryPolicy, QoSProfile, ReliabilityPolicy

from fpt_ros.messages import wild
from fpt_ros.messages.cdr import Codec
from fpt_ros.messages.frames import SECOND
from fpt_ros.messages.topics import LOOP_TOPICS, Topic
from fpt_ros.nodes import middleware
from fpt_ros.nodes.loop_node import message_class
from fpt_ros.nodes.qos import loop_qos
from fpt_ros.nodes.recorded_until import RECORDED_UNTIL, TIME


class Intruder:
    """Publishes on all loop topics, and listens to how far the run is.

    Attributes:
        stamp: of the newest cycle that is recorded [ns], -1 before.
    """

    def __init__(self, context: Context, joints: Sequence[str]) -> None:
        self.stamp = -1
        self._joints = joints
        self._node = rclpy.create_node("intruder", context=context)
        self._executor = SingleThreadedExecutor(context=context)
        self._executor.add_node(self._node)
        self._publishers: dict[Topic, Publisher] = {}
        self._node.create_subscription(message_class(TIME), RECORDED_UNTIL, self._hear, loop_qos(1))
        self._deaf: list[Any] = []

    def _hear(self, until: Any) -> None:
        self.stamp = max(self.stamp, until.sec * SECOND + until.nanosec)

    def listen(self, seconds: float) -> None:
        """Hear what there is, for a time."""
        deadline = monotonic() + seconds
        while (left := deadline - monotonic()) > 0.0:
            self._executor.spin_once(timeout_sec=left)

    def advertise(self) -> None:
        """Become a publisher of all topics; a run that is not under way yet would refuse to be."""
        for topic in LOOP_TOPICS:
            self._publishers[topic] = self._node.create_publisher(
                message_class(topic.type), topic.name, loop_qos()
            )

    def say_everything(self, seed: int) -> None:
        """Messages of all kinds on all topics, some with a stamp that may be due soon."""
        for topic, publisher in self._publishers.items():
            for ahead in (1, 5, 500):
                stamp = self.stamp + ahead * SECOND // 1000
                for data in wild.kinds(topic, stamp, self._joints, seed).values():
                    publisher.publish(data)

    def flood(self, messages: int) -> None:
        """As many messages as fast as it goes, on each topic."""
        stamp = self.stamp + SECOND // 1000
        for topic, publisher in self._publishers.items():
            data = Codec(topic).encode(wild.frame(topic, stamp, self._joints))
            for _ in range(messages):
                publisher.publish(data)

    def subscribe_and_never_take(self) -> None:
        """Reliable, with everything kept: what is heard is not taken."""
        deaf = self._node.context
        node = rclpy.create_node(f"deaf{len(self._deaf)}", context=deaf)
        qos = QoSProfile(
            history=HistoryPolicy.KEEP_ALL, depth=0, reliability=ReliabilityPolicy.RELIABLE
        )
        for topic in LOOP_TOPICS:
            node.create_subscription(
                message_class(topic.type), topic.name, lambda message: None, qos
            )
        self._deaf.append(node)

    def close(self) -> None:
        """Be gone."""
        self._executor.shutdown(timeout_sec=0.0)
        for node in (self._node, *self._deaf):
            node.destroy_node()


@contextmanager
def intruder(joints: Sequence[str]) -> Iterator[Intruder]:
    """Somebody in this ROS domain."""
    middleware.configure()
    context = Context()
    rclpy.init(context=context, args=[])
    somebody = Intruder(context, joints)
    try:
        yield somebody
    finally:
        somebody.close()
        context.try_shutdown()
