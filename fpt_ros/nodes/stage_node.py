"""A node around one stage: it waits for the messages of a cycle, steps, and publishes."""

from collections.abc import Callable, Mapping
from typing import Any

from rcl_interfaces.msg import ParameterEvent
from rclpy.parameter import Parameter as RosParameter

from fpt_ros.cycle.matcher import Matcher
from fpt_ros.cycle.stage import Stage
from fpt_ros.errors import BadInput
from fpt_ros.messages.cdr import Codec, MalformedMessage
from fpt_ros.messages.frames import SECOND, Frame
from fpt_ros.messages.topics import Topic
from fpt_ros.nodes.loop_node import LoopNode
from fpt_ros.nodes.qos import LATEST
from fpt_ros.nodes.ros_parameters import declare, watch
from fpt_ros.parameters import Value

CHANGES = "parameter_changes"
"""Topic of the changes made in flight, each with the stamp of the cycle in which it took effect."""


REASONS = 32
"""Different reasons for which a node says that it has ignored a message."""


class ParameterisedNode(LoopNode):
    """A node that holds a stage; its live parameters change the stage at the next cycle."""

    def __init__(self, kind: type[Stage]) -> None:
        super().__init__(kind.name)
        self.stage: Any = kind(declare(self, kind.parameters))
        self._pending: dict[str, Value] = {}
        self._ignored: set[str] = set()
        self._changes = self.create_publisher(ParameterEvent, CHANGES, 10)
        self._publish = self.advertise(kind.output) if self.publishes else None
        self._encode = Codec(kind.output).encode
        watch(self, self._accept)

    @property
    def publishes(self) -> bool:
        """Whether the stage takes part in the loop."""
        return True

    def _accept(self, changes: Mapping[str, Value]) -> None:
        """Try a change on a copy, keep it for the next cycle boundary.

        Raises:
            BadInput: it is refused.
        """
        ours = {name: value for name, value in changes.items() if name in self.stage.values}
        if ours:
            type(self.stage)({**self.stage.values, **self._pending, **ours})
            self._pending.update(ours)

    def apply_changes(self, stamp: int) -> None:
        """Cycle boundary: what was accepted takes effect, and is told with this cycle's stamp."""
        if not self._pending:
            return
        changes, self._pending = self._pending, {}
        self.stage.configure(changes)
        event = ParameterEvent(node=self.get_fully_qualified_name())
        event.stamp.sec, event.stamp.nanosec = divmod(stamp, SECOND)
        event.changed_parameters = [
            RosParameter(name, value=value).to_parameter_msg() for name, value in changes.items()
        ]
        self._changes.publish(event)

    def ignore(self, error: Exception) -> None:
        """Tell, once a reason, why a message was not used; the loop stays as it was."""
        reason = str(error)
        if reason not in self._ignored and len(self._ignored) < REASONS:
            self._ignored.add(reason)
            self.get_logger().error(f"ignored: {reason}")

    def send(self, frame: Frame) -> None:
        """Publish the stage's output."""
        assert self._publish is not None
        self._publish(self._encode(frame))
        self.cycles_done += 1


class StageNode(ParameterisedNode):
    """A stage that answers its inputs: denoiser, trajectory generator, tuner, deformer.

    It steps when the messages of a cycle are complete (:class:`~fpt_ros.cycle.matcher.Matcher`). A
    message that it cannot use (other bytes, a joint that is not there) is told once and ignored.
    """

    def __init__(self, kind: type[Stage]) -> None:
        super().__init__(kind)
        inputs = self.stage.inputs
        realtime = bool(self.stage.values.get("realtime", False))
        cycle_time = round(float(self.stage.values.get("cycle_time", 0.0)) * SECOND)
        self._matcher = Matcher(inputs, cycle_time, realtime)
        for i, each in enumerate(inputs):
            receive = self._receiver(i, each.topic)
            self.subscribe_raw(each.topic.name, each.topic.type, LATEST, receive)

    @property
    def publishes(self) -> bool:
        """A tuner without a method has no inputs, and is not in the loop."""
        return bool(self.stage.inputs)

    def health(self) -> tuple[str, dict[str, object]]:
        """What the stage reports."""
        return "running", self.stage.report()

    def _receiver(self, index: int, topic: Topic) -> Callable[[bytes], None]:
        take, decode = self._matcher.take, Codec(topic).decode

        def receive(data: bytes) -> None:
            try:
                frame = self.stage.admit(topic, decode(data))
            except (MalformedMessage, BadInput) as error:
                self.ignore(error)
                return
            frames = take(index, frame)
            if frames is not None:
                self._step(frames)

        return receive

    def _step(self, frames: list[Frame | None]) -> None:
        """One cycle."""
        if self._pending:
            self.apply_changes(self._matcher.acted)
        self.send(self.stage.step(*frames))


def run_stage(kind: type[Stage]) -> None:
    """Console script of a stage's node."""
    from fpt_ros.nodes.process import run_process

    run_process([lambda: StageNode(kind)], kind.name, kind.__doc__ or "")
