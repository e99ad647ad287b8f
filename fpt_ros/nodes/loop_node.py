"""What every node of the graph is: loop subscriptions that hand over bytes, and diagnostics."""

import importlib
from collections.abc import Callable
from time import monotonic
from typing import Any

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.callback_groups import CallbackGroup
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.subscription import Subscription

from fpt_ros.messages.topics import Topic
from fpt_ros.nodes.cost import Cost
from fpt_ros.nodes.parameter_service import AnsweringParameterService
from fpt_ros.nodes.qos import loop_qos
from fpt_ros.nodes.run_folder import introduce
from fpt_ros.nodes.sender import UNKNOWN, Sender
from fpt_ros.nodes.take import gid_of

DIAGNOSTICS_PERIOD = 1.0
"""Seconds between two messages on /diagnostics."""

REASONS = 32
"""Different reasons for which a node says that it has ignored a message."""


def message_class(ros_type: str) -> Any:
    """The Python class of ``package/msg/Name``."""
    package, kind, name = ros_type.split("/")
    return getattr(importlib.import_module(f"{package}.{kind}"), name)


class LoopGroup(CallbackGroup):
    """Subscriptions that executors leave alone: the spinner takes their messages, with senders.

    Attributes:
        is_open: whether an executor serves them after all.
    """

    is_open = False

    def can_execute(self, entity: Any) -> bool:
        """Asked by executors."""
        return self.is_open

    def beginning_execution(self, entity: Any) -> bool:
        """Asked by executors."""
        return self.is_open

    def ending_execution(self, entity: Any) -> None:
        """Told by executors."""


class LoopNode(Node):
    """A node whose loop messages are handled outside the executor.

    Attributes:
        loop_subscriptions: the ones that the spinner waits for and takes.
        finished: set when the node's work is done; the process then ends with status 0.
        deadline: monotonic time [s] at which :meth:`on_deadline` is due, or None.
        newest_counts: all messages that have come are taken, and then :meth:`act` is called.
        awaits_answers: it has asked others, and cannot begin before they answer.
        level: of what it tells on /diagnostics.
        warning: what is to be said of it on /diagnostics; empty: nothing.
        ignored: number of messages that were not used.
    """

    def __init__(self, name: str) -> None:
        super().__init__(name, start_parameter_services=False)
        self._answering = AnsweringParameterService(self)
        self.loop_subscriptions: list[Subscription] = []
        self.loop_group = LoopGroup()
        self.finished = self.newest_counts = self.awaits_answers = False
        self.deadline: float | None = None
        self.cycles_done = 0
        self.ignored = 0
        self.warning = ""
        self._reasons: dict[str, None] = {}
        self._senders: list[Sender] = []
        self.level = DiagnosticStatus.OK
        self._diagnostics = self.create_publisher(DiagnosticArray, "/diagnostics", 10)
        self._reported = monotonic(), 0
        self._cost = Cost()

    def subscribe_raw(
        self,
        name: str,
        ros_type: str,
        qos: QoSProfile,
        on_bytes: Callable[[bytes], bool],
    ) -> None:
        """Subscribe to a topic that has one publisher; ``on_bytes`` gets its serialised messages.

        The publisher is the first one for whose message ``on_bytes`` says that it was used.
        """
        sender = Sender(self, name, self.ignore)
        self._senders.append(sender)

        def receive(data: bytes, gid: bytes = UNKNOWN) -> None:
            if not sender.is_heard(gid):
                self.ignored += 1
            elif on_bytes(data) and sender.chosen != gid:
                sender.choose(gid)

        kind = message_class(ros_type)
        self.loop_subscriptions.append(
            self.create_subscription(
                kind, name, receive, qos, raw=True, callback_group=self.loop_group
            )
        )

    def ignore(self, reason: str) -> None:
        """Tell, once a reason, on /rosout and /diagnostics, why a message is not used."""
        self.ignored += 1
        if reason not in self._reasons and len(self._reasons) < REASONS:
            self._reasons[reason] = None
            self.get_logger().error(f"ignored: {reason}")

    def advertise(self, topic: Topic) -> Callable[[bytes], None]:
        """Advertise a loop topic; what is returned publishes a serialised message."""
        publisher = self.create_publisher(message_class(topic.type), topic.name, loop_qos())
        introduce(self.resolve_topic_name(topic.name), gid_of(publisher))
        # past what rclpy's Publisher.publish checks at every message
        return getattr(publisher.handle, "publish_raw", publisher.publish)

    def begin(self) -> None:
        """Called once when everything is set up, before the first wait."""

    def nap(self) -> None:
        """Called when all that has come is taken: more may come before it is looked at."""

    def act(self) -> None:
        """Called in real time when all that has come is taken."""

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
            if self.newest_counts:  # in lockstep nobody can take another's place
                for sender in self._senders:
                    sender.look_whether_gone()

    def _publish_diagnostics(self, rate: float) -> None:
        summary, values = self.health()
        known = {"cycles": self.cycles_done, "rate [1/s]": f"{rate:.1f}", **self._cost.values()}
        values = {**known, **values}
        level = self.level
        if self.warning:
            level = max(level, DiagnosticStatus.WARN)
            values["warning"] = self.warning
        if self.ignored:
            level = max(level, DiagnosticStatus.WARN)
            values["ignored messages"] = self.ignored
            values["ignored, last reason"] = next(reversed(self._reasons))
        status = DiagnosticStatus(
            level=level,
            name=self.get_fully_qualified_name().lstrip("/"),
            hardware_id="fpt_ros",
            message=summary,
            values=[KeyValue(key=key, value=str(value)) for key, value in values.items()],
        )
        array = DiagnosticArray(status=[status])
        array.header.stamp = self.get_clock().now().to_msg()
        self._diagnostics.publish(array)
