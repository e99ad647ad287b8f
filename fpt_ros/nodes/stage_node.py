"""A node around one stage: it waits for the messages of a cycle, steps, and publishes."""

from collections.abc import Callable, Mapping
from time import time_ns
from typing import Any

from rcl_interfaces.msg import ParameterEvent
from std_srvs.srv import Trigger

from fpt_ros.cycle.arrivals import Arrivals
from fpt_ros.cycle.matcher import Matcher
from fpt_ros.cycle.stage import AUTOSTART, Stage
from fpt_ros.errors import BadInput
from fpt_ros.messages.cdr import Codec, MalformedMessage
from fpt_ros.messages.frames import SECOND, Frame
from fpt_ros.messages.topics import JOINT_STATES, Topic
from fpt_ros.nodes.kept import Kept, KeptCycle
from fpt_ros.nodes.managed import ManagedNode
from fpt_ros.nodes.process import report_progress
from fpt_ros.nodes.qos import LATEST, heard_qos, loop_qos, sensor_qos
from fpt_ros.nodes.recent import Recent
from fpt_ros.nodes.reset import BEGIN_AGAIN
from fpt_ros.nodes.ros_parameters import declare, of_node, watch
from fpt_ros.nodes.run_over import end_with_plant
from fpt_ros.parameters import Value

CHANGES = "parameter_changes"
"""Topic of the changes made in flight, each with the stamp of the cycle in which it took effect."""

FORGETS = "forgets"
"""Kept: stamp of the cycle after which all that was remembered counts no more."""


class ParameterisedNode(ManagedNode):
    """A node that holds a stage; its live parameters change the stage at the next cycle."""

    def __init__(self, kind: type[Stage]) -> None:
        super().__init__(kind.name)
        self._kept = Kept(kind.name, self.get_logger().error)
        given = declare(self, kind.parameters)
        changed, cycles = self._kept.rewind(self._goes_on_at()), self._kept.cycles
        self.stage: Any = kind({**given, **changed}, cycles[-1].state if cycles else None)
        self._pending = dict(self._kept.pending)
        known = {**changed, **self._pending}
        self.set_parameters([of_node(self, name, value) for name, value in known.items()])
        self._changes = self.create_publisher(ParameterEvent, CHANGES, loop_qos())
        self._publish = self.advertise(kind.output) if self.publishes else None
        self._recent = Recent(self, kind.output)
        self._encode = Codec(kind.output).encode
        self._sent = b""
        if cycles:
            self._go_on_from(cycles)
        watch(self, self._accept)

    def _goes_on_at(self) -> int:
        """Stamp [ns] of the first cycle whose changes of parameters are not in force yet."""
        return self._kept.cycles[-1].stamp + 1 if self._kept.cycles else 0

    def _go_on_from(self, cycles: list[KeptCycle]) -> None:
        """In the place of a process that was killed: its messages are there again as well."""
        latest = cycles[-1]
        self.stage.clock[0], self.stage.clock[1] = latest.clock
        self.cycles_done, self._sent = latest.done, latest.output
        for stamp, values in self._kept.told:
            self._tell(stamp, values)
        for each in cycles:
            if self._publish is not None:
                self._publish(each.output)
        self.get_logger().warning(f"started again: {latest.done} cycles are done")

    @property
    def publishes(self) -> bool:
        """Whether the stage takes part in the loop."""
        return True

    @property
    def stamp(self) -> int:
        """Of the latest cycle [ns]."""
        raise NotImplementedError

    def begin(self) -> None:
        """It starts itself, where nobody else is to."""
        super().begin()
        if self.stage.values[AUTOSTART.name]:
            self.start_itself()

    def _accept(self, changes: Mapping[str, Value]) -> None:
        """Try a change on a copy, keep it for the next cycle boundary.

        Raises:
            BadInput: it is refused.
        """
        ours = {name: value for name, value in changes.items() if name in self.stage.values}
        if ours:
            tried = type(self.stage)({**self.stage.values, **self._pending, **ours})
            self.consider(tried, set(ours))
            self._kept.accept({**self._pending, **ours})
            self._pending.update(ours)

    def consider(self, tried: Any, names: set[str]) -> None:
        """Look at a valid change of these parameters; ``tried``: the stage that it makes.

        Raises:
            BadInput: it is refused.
        """

    def apply_changes(self, stamp: int) -> None:
        """Cycle boundary: what was accepted takes effect, and is told with this cycle's stamp."""
        if not self._pending:
            return
        changes, self._pending = self._pending, {}
        self.stage.configure(changes)
        self._kept.put_into_force(stamp, changes)
        self._tell(stamp, changes)

    def _tell(self, stamp: int, changes: Mapping[str, Value]) -> None:
        """Say that parameters have changed."""
        event = ParameterEvent(node=self.get_fully_qualified_name())
        event.stamp.sec, event.stamp.nanosec = divmod(stamp, SECOND)
        event.changed_parameters = [
            of_node(self, name, value).to_parameter_msg() for name, value in changes.items()
        ]
        self._changes.publish(event)

    def send(self, frame: Frame) -> None:
        """Publish the stage's output, once it is kept."""
        assert self._publish is not None
        self._sent = sent = self._encode(frame)
        self.cycles_done += 1
        self._kept.add(self.stamp, self.stage, self.cycles_done, sent)
        self._publish(sent)
        self._recent.add(sent)

    def housekeeping(self) -> None:
        """Tell who watches what is new."""
        super().housekeeping()
        self._recent.tell(self.cycles_done)

    def send_again(self) -> None:
        """Publish the last output once more: who has it ignores it, who waits for it goes on."""
        if self._publish is not None and self._sent:
            self._publish(self._sent)


class StageNode(ParameterisedNode):
    """A stage that answers its inputs: denoiser, trajectory generator, tuner, deformer.

    It steps when the messages of a cycle are complete (:class:`~fpt_ros.cycle.matcher.Matcher`). A
    message that it cannot use (other bytes, a joint that is not there) is told once and ignored.
    """

    def __init__(self, kind: type[Stage], reports: bool = True) -> None:
        """``reports``: whether it tells how many cycles are done, if nobody else does."""
        super().__init__(kind)
        self._reports = reports
        self._deaf = not self.stage.values[AUTOSTART.name]
        end_with_plant(self, self.stage.values)
        inputs = self._inputs = self.stage.inputs
        realtime = bool(self.stage.values.get("realtime", False))
        cycle_time = round(float(self.stage.values.get("cycle_time", 0.0)) * SECOND)
        acted = self._kept.cycles[-1].stamp if self._kept.cycles else -1
        self._matcher = Matcher(inputs, cycle_time, realtime, acted)
        self._realtime = self.newest_counts = realtime
        self._begins_again = bool(self._kept.cycles) and self._kept.aside.get(FORGETS) == acted
        self.create_service(Trigger, f"~/{BEGIN_AGAIN}", self._on_begin_again)
        self._robot = bool(self.stage.values.get("robot", False))
        if self._robot and not realtime:
            raise BadInput(f"{kind.name}.robot: a robot lives in wall time, set realtime as well")
        for i, each in enumerate(inputs):
            of_robot = self._robot and each.topic is JOINT_STATES
            qos = sensor_qos(LATEST) if of_robot else heard_qos(realtime)
            receive = self._receiver(i, each.topic)
            self.subscribe_raw(each.topic.name, each.topic.type, qos, receive)

    @property
    def publishes(self) -> bool:
        """A tuner without a method has no inputs, and is not in the loop."""
        return bool(self.stage.inputs)

    @property
    def stamp(self) -> int:
        """Of the cycle acted on last [ns]."""
        return self._matcher.acted

    def health(self) -> tuple[str, dict[str, object]]:
        """What the stage reports."""
        summary, values = super().health()
        return summary, {**values, **self.stage.report()}

    def heard(self, topic: Topic, frame: Frame) -> None:
        """Called with each message that can be used, before its cycle is looked for."""

    def take_up(self) -> None:
        """Active: it answers. In lockstep what it has missed is said again."""
        self._deaf = False

    def lay_down(self) -> None:
        """Inactive: it does not hear. The loop waits; in real time the safe effort is commanded."""
        self._deaf = True

    def housekeeping(self) -> None:
        """Progress, where it is not the plant that tells it."""
        super().housekeeping()
        if self._reports:
            report_progress(self.cycles_done)

    def _receiver(self, index: int, topic: Topic) -> Callable[[bytes], bool]:
        take, decode = self._matcher.take, Codec(topic).decode
        arrivals = Arrivals() if self._robot and topic is JOINT_STATES else None

        def receive(data: bytes) -> bool:
            if self._deaf:
                return False
            try:
                frame = self.stage.admit(topic, decode(data))
            except (MalformedMessage, BadInput) as error:
                self.ignore(str(error))
                return False
            if arrivals is not None:
                frame = self._in_time(arrivals, frame)
            self.heard(topic, frame)
            frames = take(index, frame)
            if self._realtime:
                return True
            if frames is not None:
                self._step(frames)
            elif frame.stamp == self._matcher.acted and self._inputs[index].lag == 0:
                self.send_again()
            return frame.stamp == 0

        return receive

    def act(self) -> None:
        """The newest cycle; those before it were not in time."""
        frames = self._matcher.newest()
        if frames is not None:
            self._step(frames)

    def _in_time(self, arrivals: Arrivals, frame: Frame) -> Frame:
        """A robot's message with a stamp that can be used."""
        replaced = arrivals.replaced
        stamp = arrivals.stamp(frame.stamp, time_ns())
        if replaced == 0 and arrivals.replaced:
            self.get_logger().warning(
                f"stamps of joint_states are missing or of a clock that was set ({frame.stamp} "
                "ns): the time of arrival counts from now on"
            )
        return frame._replace(stamp=stamp)

    def _step(self, frames: list[Frame | None]) -> None:
        """One cycle."""
        if self._pending:
            self.apply_changes(self._matcher.acted)
        if self._begins_again:
            self._begins_again = False
            self.stage.begin_again()
            pairs = zip(self._inputs, frames, strict=True)
            frames = [None if each.lag else frame for each, frame in pairs]  # of no cycle before
        self.send(self.stage.step(*frames))

    def _on_begin_again(
        self, request: Trigger.Request, answer: Trigger.Response
    ) -> Trigger.Response:
        self._begins_again = True
        self._kept.aside[FORGETS] = self._matcher.acted
        self._kept.save()
        answer.success, answer.message = True, "the next cycle is the first one"
        return answer


def run_stage(kind: type[Stage]) -> None:
    """Console script of a stage's node."""
    from fpt_ros.nodes.process import run_process

    run_process([lambda: StageNode(kind)], kind.name, kind.__doc__ or "")
