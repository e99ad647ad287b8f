"""What every node of the graph is: loop subscriptions that hand over bytes, and diagnostics."""

import importlib
from collections.abc import Callable
from time import monotonic
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.node import Node
from rclpy.subscription import Subscription

from fpt_ros.messages.topics import Topic
from fpt_ros.nodes.qos import loop_qos

DIAGNOSTICS_PERIOD = 1.0
"""Seconds between two messages on /diagnostics."""


def message_class(ros_type: str) -> Any:
    """The Python class of ``package/msg/Name``."""
    package, kind, name = ros_type.split("/")
    return getattr(importlib.import_module(f"{package}.{kind}"), name)


class LoopNode(Node):
    """A node whose loop messages are handled outside the executor.

    Attributes:
        loop_subscriptions: the ones that the spinner waits for and takes.
        finished: set when the node's work is done; the process then ends with status 0.
        deadline: monotonic time [s] at which :meth:`on_deadline` is due, or None.
        level: of what it tells on /diagnostics.
    """

    def __init__(self, name: str) -> None:
        super().__init__(name)
        self.loop_subscriptions: list[Subscription] = []
        self.finished = False
        self.deadline: float | None = None
        self.cycles_done = 0
        self.level = DiagnosticStatus.OK
        self._diagnostics = self.create_publisher(DiagnosticArray, "/diagnostics", 10)
        self._reported = monotonic(), 0

    def subscribe_raw(
        self, name: str, ros_type: str, depth: int, on_bytes: Callable[[bytes], None]
    ) -> None:
        """Subscribe to a latched, reliable topic; ``on_bytes`` gets its serialised messages."""
        kind = message_class(ros_type)
        self.loop_subscriptions.append(
            self.create_subscription(kind, name, on_bytes, loop_qos(depth), raw=True)
        )

    def advertise(self, topic: Topic) -> Callable[[bytes], None]:
        """Advertise a loop topic; what is returned publishes a serialised message."""
        publisher = self.create_publisher(message_class(topic.type), topic.name, loop_qos())
        # past what rclpy's Publisher.publish checks at every message
        return getattr(publisher.handle, "publish_raw", publisher.publish)

    def begin(self) -> None:
        """Called once when everything is set up, before the first wait."""

    def on_deadline(self) -> None:
        """Called when ``deadline`` has passed."""

    def close(self) -> None:
        """Called once when the process ends, whatever the reason."""

    def health(self) -> tuple[str, dict[str, object]]:
        """A summary in words and the values that go to /diagnostics."""
        return "running", {}

    def housekeeping(self) -> None:
        """Called every few dozen milliseconds, outside the hot path."""
        now = monotonic()
        since, cycles = self._reported
        if now - since >= DIAGNOSTICS_PERIOD:
            self._publish_diagnostics((self.cycles_done - cycles) / (now - since))
            self._reported = now, self.cycles_done

    def _publish_diagnostics(self, rate: float) -> None:
        summary, values = self.health()
        values = {"cycles": self.cycles_done, "rate [1/s]": f"{rate:.1f}", **values}
        status = DiagnosticStatus(
            level=self.level,
            name=self.get_fully_qualified_name().lstrip("/"),
            hardware_id="fpt_ros",
            message=summary,
            values=[KeyValue(key=key, value=str(value)) for key, value in values.items()],
        )
        array = DiagnosticArray(status=[status])
        array.header.stamp = self.get_clock().now().to_msg()
        self._diagnostics.publish(array)
