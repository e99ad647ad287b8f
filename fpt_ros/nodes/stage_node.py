"""A node around one stage: it waits for the messages of a cycle, steps, and publishes."""

from collections.abc import Mapping
from typing import Any

from rcl_interfaces.msg import ParameterEvent
from rclpy.parameter import Parameter as RosParameter

from fpt_ros.cycle.stage import Stage
from fpt_ros.errors import RunFailed
from fpt_ros.messages.cdr import Codec, MalformedMessage
from fpt_ros.messages.frames import SECOND, Frame
from fpt_ros.nodes.loop_node import LoopNode
from fpt_ros.nodes.qos import LATEST
from fpt_ros.nodes.ros_parameters import declare, watch
from fpt_ros.parameters import Value

CHANGES = "parameter_changes"
"""Topic of the changes made in flight, each with the stamp of the cycle in which it took effect."""


class ParameterisedNode(LoopNode):
    """A node that holds a stage; its live parameters change the stage at the next cycle."""

    def __init__(self, kind: type[Stage]) -> None:
        super().__init__(kind.name)
        self.stage: Any = kind(declare(self, kind.parameters))
        self._pending: dict[str, Value] = {}
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

    def send(self, frame: Frame) -> None:
        """Publish the stage's output."""
        assert self._publish is not None
        self._publish(self._encode(frame))
        self.cycles_done += 1


class StageNode(ParameterisedNode):
    """A stage that answers its inputs: denoiser, trajectory generator, tuner, deformer.

    In lockstep it steps when all messages of a cycle are there. In real time it steps as soon as
    those of the newest cycle are, and takes the newest there is of what is optional.
    """

    def __init__(self, kind: type[Stage]) -> None:
        super().__init__(kind)
        inputs = self.stage.inputs
        self._latest: list[Any] = [None] * len(inputs)
        self._lags = tuple(each.lag for each in inputs)
        self._codecs = tuple(Codec(each.topic) for each in inputs)
        self._acted = -1
        self._wait_for = tuple(i for i, lag in enumerate(self._lags) if lag == 0)
        self._realtime = bool(self.stage.values.get("realtime", False))
        self._cycle_time = round(float(self.stage.values.get("cycle_time", 0.0)) * SECOND)
        for i, each in enumerate(inputs):
            self.subscribe_raw(each.topic.name, each.topic.type, LATEST, self._receiver(i))

    @property
    def publishes(self) -> bool:
        """A tuner without a method has no inputs, and is not in the loop."""
        return bool(self.stage.inputs)

    def _receiver(self, index: int) -> Any:
        decode = self._codecs[index].decode

        def receive(data: bytes) -> None:
            try:
                frame = decode(data)
            except MalformedMessage as error:
                self.get_logger().error(f"ignored: {error}", once=True)
                return
            if frame.stamp < self._acted and not self._realtime:
                return  # of a run that has begun later: it must not take the place of ours
            self._latest[index] = frame
            self._try_step()

        return receive

    def _try_step(self) -> None:
        """Step if the messages of a cycle not acted on are complete."""
        latest = self._latest
        first = latest[self._wait_for[0]]
        if first is None or first.stamp <= self._acted:
            return
        stamp, last = first.stamp, self.stage.clock[1]
        arguments = []
        for frame, lag in zip(latest, self._lags, strict=True):
            wanted = last if lag else stamp
            if frame is not None and frame.stamp == wanted:
                arguments.append(frame)
            elif lag and (last < 0 or self._realtime):
                arguments.append(None)
            else:
                return
        due = last + self._cycle_time if last >= 0 else 0
        unknown = last >= 0 and not self._cycle_time
        if not (self._realtime or unknown) and stamp != due:
            raise under_way(stamp)
        self._acted = stamp
        if self._pending:
            self.apply_changes(stamp)
        self.send(self.stage.step(*arguments))


def under_way(stamp: int) -> RunFailed:
    """For who comes to a run in lockstep that is not at its first cycle, but at ``stamp`` [ns]."""
    return RunFailed(
        f"a run is under way here already (t = {stamp / SECOND:g} s): use another ROS_DOMAIN_ID "
        "or --namespace"
    )


def run_stage(kind: type[Stage]) -> None:
    """Console script of a stage's node."""
    from fpt_ros.nodes.process import run_process

    run_process([lambda: StageNode(kind)], kind.name, kind.__doc__ or "")
