"""Replay into a node that is running: its recorded inputs over DDS, its answers compared.

In lockstep a cycle begins when the node has answered the one before; by the clock it begins when it
did in the recording, or faster or slower by a rate. Changes in flight are set over the node's own
services before the cycle in which they took effect.
"""

import os
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from time import monotonic
from typing import NamedTuple

from rcl_interfaces.srv import SetParameters
from rclpy.parameter import Parameter as RosParameter

from fpt_ros.cycle.plant_simulator import PlantSimulator
from fpt_ros.errors import BadInput, Interrupted, RunFailed
from fpt_ros.messages.cdr import Codec, MalformedMessage
from fpt_ros.messages.frames import SECOND, Frame
from fpt_ros.messages.topics import LOOP_TOPICS, Topic
from fpt_ros.nodes.loop_node import LoopNode, message_class
from fpt_ros.nodes.process import Stop, run_nodes
from fpt_ros.nodes.qos import HEARD, loop_qos
from fpt_ros.nodes.recorded_until import BEGUN, RECORDED_UNTIL, TIME, encode_time
from fpt_ros.replay.compared import Comparison
from fpt_ros.replay.recorded import Cycle
from fpt_ros.replay.replayed import Out, Outcome, Progress, Replay

NAME = "replay"

PATIENCE = 20.0
"""Seconds in which the node has to be found, and to give an answer."""

LAST_ANSWERS = 2.0
"""Seconds for the last answers, by the clock."""


def run_live(
    replay: Replay, rate: float | None, progress: Progress, out: Out | None = None
) -> Outcome:
    """Replay into the running node of that name.

    Args:
        replay: prepared; its stage tells what the node needs.
        rate: how many times as fast as recorded; None: in lockstep.
        progress: is told how many cycles are done.
        out: takes the node's answers.

    Raises:
        BadInput: the node has a clock of its own, or the rate is not positive.
        RunFailed: there is no such node, or it does not answer.
        Interrupted: Ctrl-C.
    """
    is_plant = isinstance(replay.stage, PlantSimulator)
    if is_plant and (rate is not None or replay.recorded.realtime):
        raise BadInput(
            "a running plant_simulator has a clock of its own: without --live it is replayed here"
        )
    if rate is not None and not 0.0 < rate < float("inf"):
        raise BadInput(f"--rate {rate:g}: it takes a positive number, 1 is as fast as recorded")
    # the inputs of a node are nothing that a network should hear
    os.environ.setdefault("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    nodes: list[_ReplayNode] = []

    def make() -> LoopNode:
        nodes.append(_ReplayNode(replay, rate, progress, out))
        return nodes[0]

    stop = Stop()
    namespace = replay.recorded.prefix
    run_nodes([make], stop, [NAME, "--ros-args", "-r", f"__ns:={namespace or '/'}"])
    if stop.signal:
        raise Interrupted("interrupted")
    return Outcome.of(nodes[0].comparison, *replay.recorded.missing, nodes[0].end)


class Wait(NamedTuple):
    """What the replay waits for.

    Attributes:
        ready: whether it is there.
        failure: what to say when it has not come in :data:`PATIENCE`; empty: it may take longer.
    """

    ready: Callable[[], bool]
    failure: str = ""


class _ReplayNode(LoopNode):
    """Publishes what a node has heard, and listens to it.

    Attributes:
        comparison: of its answers with the recorded ones.
        end: why the replay went no further than it did, if it is not that of the recording.
    """

    def __init__(
        self, replay: Replay, rate: float | None, progress: Progress, out: Out | None
    ) -> None:
        super().__init__(NAME)
        stage, recorded = replay.stage, replay.recorded
        self.comparison, self.end = Comparison(recorded.prefix), ""
        self._recorded, self._rate = recorded, rate
        self._progress, self._out = progress, out
        self._node, self._output = stage.name, stage.output
        self._decode = Codec(stage.output).decode
        inputs = {each.topic for each in stage.inputs}
        place = LOOP_TOPICS.index(stage.output)
        self._before = [topic for topic in LOOP_TOPICS[:place] if topic in inputs]
        self._needed = [each.topic for each in stage.inputs if not (each.lag or each.optional)]
        self._behind = [topic for topic in LOOP_TOPICS[place:] if topic in inputs]
        self._inputs = {
            topic.name: self.create_publisher(message_class(topic.type), topic.name, loop_qos())
            for topic in inputs
        }
        self._until = None
        if isinstance(stage, PlantSimulator):  # it may wait for a recorder
            self._until = self.create_publisher(message_class(TIME), RECORDED_UNTIL, loop_qos(1))
        self.subscribe_raw(stage.output.name, stage.output.type, loop_qos(HEARD), self._on_answer)
        self._set = self.create_client(SetParameters, f"{stage.name}/set_parameters")
        own = [change for change in recorded.changes if change.node == stage.name]
        self._changes = deque(sorted(own, key=lambda change: change.stamp))
        self._expected: dict[int, Cycle] = {}
        self._script = self._steps()
        self._wait = Wait(lambda: True)
        self._since = monotonic()

    def _steps(self) -> Iterator[Wait]:
        """All that is to be done, and waited for."""
        yield Wait(self._matched, f"there is no node {self._node} that listens: start it first")
        self._acknowledge(BEGUN)
        origin, first = monotonic(), -1
        for due, cycle in enumerate(self._recorded.cycles()):
            if cycle.number != due and not self._recorded.realtime:
                self.end = f"cycle {due} is not in the recording"
                break
            first = cycle.stamp if first < 0 else first
            if self._rate is not None:
                self.deadline = origin + (cycle.stamp - first) / SECOND / self._rate
                yield Wait(lambda: self.deadline is None)
            if self._output.name in cycle.messages and self._is_asked(cycle):
                self._expected[cycle.stamp] = cycle
            elif self._out is not None:
                self._out.add(cycle, self._output, None)
            if self._before:
                yield from self._change(cycle.stamp)
            if self._expected or not self._recorded.realtime:
                self._publish(cycle, self._before)
            if self._rate is None:
                yield Wait(
                    lambda: not self._expected,
                    f"{self._node} gives no answer to cycle {cycle.number}: it has to be fresh, "
                    "and have the parameters of the recording",
                )
            if not self._before:
                yield from self._change(cycle.stamp)
            self._publish(cycle, self._behind)
            self._acknowledge(cycle.stamp)
            self._progress(cycle.number + 1)
        last = monotonic()
        yield Wait(lambda: not self._expected or monotonic() > last + LAST_ANSWERS)
        for cycle in self._expected.values():
            self._compare(cycle, None)

    def _is_asked(self, cycle: Cycle) -> bool:
        """The node's answer is one to what is recorded; the plant begins by itself."""
        return not self._before or all(topic.name in cycle.messages for topic in self._needed)

    def _publish(self, cycle: Cycle, topics: Iterable[Topic]) -> None:
        for topic in topics:
            if topic.name in cycle.messages:
                self._inputs[topic.name].publish(cycle.messages[topic.name])

    def _acknowledge(self, stamp: int) -> None:
        if self._until is not None:
            self._until.publish(encode_time(stamp))

    def _change(self, stamp: int) -> Iterator[Wait]:
        """Set what changed in this cycle; the node puts it into force when it acts next."""
        while self._changes and self._changes[0].stamp <= stamp:
            change = self._changes.popleft()
            yield Wait(self._set.service_is_ready, f"{self._node} has no parameter services")
            request = SetParameters.Request(
                parameters=[
                    RosParameter(name, value=value).to_parameter_msg()
                    for name, value in change.values.items()
                ]
            )
            future = self._set.call_async(request)
            yield Wait(future.done, f"{self._node} does not answer when its parameters are set")
            for result in future.result().results:
                if not result.successful:
                    raise RunFailed(f"{self._node} refuses a recorded change: {result.reason}")

    def _matched(self) -> bool:
        """The node listens to all that is published here, and is heard."""
        for name, publisher in self._inputs.items():
            if self.count_publishers(name) > 1:
                raise RunFailed(
                    f"another node publishes {self.resolve_topic_name(name)}: a replay must not "
                    "mix with a run"
                )
            if not publisher.get_subscription_count():
                return False
        return self.loop_subscriptions[0].get_publisher_count() > 0

    def _on_answer(self, data: bytes) -> bool:
        try:
            frame = self._decode(data)
        except MalformedMessage as error:
            self.ignore(str(error))
            return False
        cycle = self._expected.pop(frame.stamp, None)
        if cycle is None:
            return False
        self._compare(cycle, frame)
        self._go_on()
        return True

    def _compare(self, cycle: Cycle, frame: Frame | None) -> None:
        was = cycle.messages[self._output.name]
        self.comparison.add(self._output, cycle.number, was, frame)
        if self._out is not None:
            self._out.add(cycle, self._output, frame)

    def _go_on(self) -> None:
        """Do all that does not have to wait."""
        try:
            while self._wait.ready():
                self._wait, self._since = next(self._script), monotonic()
        except StopIteration:
            self._wait, self.finished = Wait(lambda: False), True

    def on_deadline(self) -> None:
        """The clock has come to the next cycle."""
        self.deadline = None
        self._go_on()

    def housekeeping(self) -> None:
        """Look for what does not come as a message; give up what does not come at all."""
        super().housekeeping()
        self._go_on()
        if self._wait.failure and monotonic() > self._since + PATIENCE:
            raise RunFailed(self._wait.failure)
