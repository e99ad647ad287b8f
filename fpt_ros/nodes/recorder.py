"""The recorder: every message of every topic, as the bytes that came, into MCAP.

It begins when it hears all nodes of the loop and knows the parameters that they really have;
until then the plant waits, if it is told to (:mod:`fpt_ros.nodes.recorded_until`). What it says
that it has is on disk, or in the hands of the operating system. It checks what it gets:
message k of every loop topic carries the same stamp, or the recording is not complete.

Where the recording cannot be written any more, the run goes on, and the recorder says so.
"""

import os
import struct
import sys
from array import array
from collections.abc import Callable
from itertools import pairwise
from time import time_ns

from diagnostic_msgs.msg import DiagnosticStatus
from rclpy.subscription import Subscription

from fpt_ros import __version__
from fpt_ros.bags.split import Split
from fpt_ros.bags.writer import BagWriter
from fpt_ros.cycle.arrivals import Arrivals
from fpt_ros.cycle.matcher import under_way
from fpt_ros.cycle.turns import Turns
from fpt_ros.errors import RunFailed
from fpt_ros.experiments import description
from fpt_ros.messages.cdr import Codec, MalformedMessage
from fpt_ros.messages.frames import SECOND
from fpt_ros.messages.topics import DEPTH, JOINT_STATES, LOOP_TOPICS, TUNING, Topic
from fpt_ros.nodes.loop_node import LoopNode, message_class
from fpt_ros.nodes.qos import HEARD, loop_qos, sensor_qos
from fpt_ros.nodes.recorded_run import reason_to_end, recorded_run
from fpt_ros.nodes.recorded_until import BEGUN, RECORDED_UNTIL, TIME, encode_time
from fpt_ros.nodes.ros_parameters import declare
from fpt_ros.nodes.snapshot import Snapshot
from fpt_ros.nodes.stage_node import CHANGES
from fpt_ros.parameters import integer, word

ACKNOWLEDGE = 8
"""Cycles between two messages to the plant."""

SIDE_TOPICS = {
    "/diagnostics": "diagnostic_msgs/msg/DiagnosticArray",
    "/rosout": "rcl_interfaces/msg/Log",
    "/parameter_events": "rcl_interfaces/msg/ParameterEvent",
    CHANGES: "rcl_interfaces/msg/ParameterEvent",
}
"""Recorded as they come; no cycle depends on them."""

SIDE_DEPTH = 1000
"""Messages of a side topic that may wait to be recorded."""

NICE = 10
"""In real time the loop comes first: misses with a recorder were down by a third to a half."""

Message = tuple[str, str, int, bytes]  # name and type of the topic, stamp [ns], bytes

_STAMP = struct.Struct("<iI")


class Recorder(LoopNode):
    """Subscribes to every topic of the graph and writes a rosbag2 directory."""

    def __init__(self) -> None:
        super().__init__(description.NODE)
        values = declare(self, description.parameters)
        self._lockstep = values.get("realtime") is not True
        self._robot = values.get("robot") is True
        self._cycles = integer(values, "cycles")
        run = recorded_run(values)
        self._parameters = run.parameters
        self._writer = BagWriter(
            run.directory,
            self._parameters,
            {
                "experiment": run.experiment,
                "variant": run.variant,
                "engine": "graph",
                "version": __version__,
                "namespace": self.get_namespace(),
                "clock": "lockstep" if self._lockstep else "realtime",
            },
            Split.parse(word(values, "split")),
            aside=True,
        )
        self._stamps = array("q")
        self._counts: list[int] = []
        self._acknowledged = 0
        self._lost: RunFailed | None = None
        self._snapshot: Snapshot | None = None
        self._started = False
        self._side_subscriptions: list[tuple[Subscription, Callable[[bytes], None]]] = []
        self._until = self.create_publisher(message_class(TIME), RECORDED_UNTIL, loop_qos(1))
        for topic in LOOP_TOPICS:
            if topic != TUNING or values.get("await_tuning") is True:
                self._record_loop_topic(topic)
        self._turns = Turns[Message](len(self._counts))
        for name, kind in SIDE_TOPICS.items():
            self._record_side_topic(name, kind)

    def _record_loop_topic(self, topic: Topic) -> None:
        index, name, kind = len(self._counts), topic.name, topic.type
        self._counts.append(0)
        self._writer.add_topic(self.resolve_topic_name(name), kind, DEPTH)
        qos = sensor_qos(HEARD) if self._robot and topic is JOINT_STATES else loop_qos(HEARD)
        self.subscribe_raw(name, kind, qos, self._on_loop_message(index, topic))

    def _write(self, name: str, kind: str, stamp: int, data: bytes) -> None:
        """Record a message; where that cannot be done any more, say so once."""
        if self._lost is not None:
            return
        try:
            self._writer.write(name, kind, stamp, data)
        except RunFailed as error:
            self._lost = RunFailed(
                f"the recording ends after {self._done()} cycles, the run went on: {error}"
            )
            self.level = DiagnosticStatus.ERROR
            self.get_logger().error(str(self._lost))
            self._publish_diagnostics(0.0)

    def health(self) -> tuple[str, dict[str, object]]:
        """Whether it records."""
        if self._lost is not None:
            return str(self._lost), {}
        return ("recording" if self._started else "waiting for the nodes of the loop"), {}

    def _on_loop_message(self, index: int, topic: Topic) -> Callable[[bytes], bool]:
        write, counts, stamps = self._write, self._counts, self._stamps
        arrivals = Arrivals() if self._robot and topic is JOINT_STATES else None
        name, kind, decode = self.resolve_topic_name(topic.name), topic.type, Codec(topic).decode

        def record(data: bytes) -> bool:
            try:
                seconds, nanoseconds = _STAMP.unpack_from(data, 4)
                stamp = seconds * SECOND + nanoseconds
                if arrivals is not None:
                    stamp = arrivals.stamp(stamp, time_ns())
                if self._is_unexpected(index, stamp):
                    decode(data)
                if stamp < 0:
                    raise MalformedMessage
            except (struct.error, MalformedMessage):
                self.ignore(f"{name}: {len(data)} bytes that are not a {kind}")
                return False
            count = counts[index]
            if self._lockstep:
                if count and stamp <= stamps[count - 1]:
                    return False  # not of this run: a second plant that is about to give up
                if count == 0 and stamp > 0:
                    raise under_way(stamp)
                if count == len(stamps):
                    stamps.append(stamp)
                elif stamps[count] != stamp:
                    raise RunFailed(
                        f"the recording is not complete: message {count} of {name} has the stamp "
                        f"{stamp / SECOND:.9g} s, {stamps[count] / SECOND:.9g} s was due"
                    )
            elif index == 0:  # the plant's own: of every cycle, others may miss one
                stamps.append(stamp)
            counts[index] = count + 1
            if self._lockstep:
                for message in self._turns.add(index, (name, kind, stamp, data)):
                    write(*message)
            else:
                write(name, kind, stamp, data)
            if self._done() >= self._acknowledged + ACKNOWLEDGE:
                self._acknowledge()
            return True

        return record

    def _is_unexpected(self, index: int, stamp: int) -> bool:
        """Whether this is not the stamp that follows, so that the bytes may be anything."""
        stamps, count = self._stamps, self._counts[index]
        if count < len(stamps):
            return stamps[count] != stamp
        return len(stamps) < 2 or stamp - stamps[-1] != stamps[-1] - stamps[-2]

    def _done(self) -> int:
        """Cycles recorded: of all topics in lockstep; in real time some answers may be missing."""
        return min(self._counts) if self._lockstep else len(self._stamps)

    def _acknowledge(self) -> None:
        done = self._done()
        if self._started and done > self._acknowledged:
            self._acknowledged = self.cycles_done = done
            self._until.publish(encode_time(self._stamps[done - 1]))

    def _record_side_topic(self, name: str, kind: str) -> None:
        resolved = self.resolve_topic_name(name)
        self._writer.add_topic(resolved, kind)

        def record(data: bytes) -> None:
            stamp = self._stamps[-1] if self._stamps else 0
            self._write(resolved, kind, stamp, data)

        # /rosout is latched: what was said before we came is recorded too
        qos = loop_qos(SIDE_DEPTH) if name == "/rosout" else SIDE_DEPTH
        subscription = self.create_subscription(message_class(kind), name, record, qos, raw=True)
        self._side_subscriptions.append((subscription, record))
        if name == CHANGES:
            self._changes = subscription

    def begin(self) -> None:
        """In real time the loop comes first."""
        if not self._lockstep:
            os.nice(NICE)

    def housekeeping(self) -> None:
        """Begin when all is there; acknowledge the last few cycles too."""
        super().housekeeping()
        if not self._started:
            self._try_to_start()
        self._acknowledge()

    def _try_to_start(self) -> None:
        if self._snapshot is None:
            names = self._loop_nodes()
            if self._matched() and not any("UNKNOWN" in name for name in names):
                self._snapshot = Snapshot(self, names)
            return
        if not self._snapshot.is_done():
            return
        for name, values in self._snapshot.parameters.items():
            self._parameters[name] = {**self._parameters.get(name, {}), **values}
        for problem in self._snapshot.problems:
            self.get_logger().warning(problem)
        if self._lost is None:
            self._writer.set_parameters(self._parameters)
        self._started = True
        self._until.publish(encode_time(BEGUN))

    def _matched(self) -> bool:
        """Whether it hears all nodes: each loop topic, and all changes of parameters."""
        heard = all(each.get_publisher_count() for each in self.loop_subscriptions)
        return heard and self._changes.get_publisher_count() >= self.count_publishers(CHANGES)

    def _loop_nodes(self) -> list[str]:
        """Fully qualified names of the nodes that publish the loop's topics."""
        found: dict[str, None] = {}
        for each in self.loop_subscriptions:
            for about in self.get_publishers_info_by_topic(each.topic_name):
                found[f"{about.node_namespace.rstrip('/')}/{about.node_name}"] = None
        return list(found)

    def _take_what_has_come(self) -> None:
        """Side topics are looked at now and then: the last reports of the others wait unread."""
        for subscription, record in self._side_subscriptions:
            for _ in range(SIDE_DEPTH):
                taken = subscription.handle.take_message(subscription.msg_type, True)
                if taken is None:
                    break
                record(taken[0])

    def close(self) -> None:
        """Finish the file; say why, if the run did not end by itself.

        Raises:
            RunFailed: the recording could not be written to the end.
        """
        error = sys.exc_info()[1]
        self._take_what_has_come()
        for message in self._turns.rest():
            self._write(*message)
        reason = reason_to_end() or (str(error) if error is not None else "")
        if self._lost is not None:
            raise self._lost
        if not reason and len(self._stamps) < self._cycles:
            reason = f"the recorder was stopped after {len(self._stamps)} of {self._cycles} cycles"
        if not reason and self._lockstep and len(set(self._counts)) > 1:
            reason = "the recorder was stopped in the middle of a cycle"
        self._writer.close(reason)
        if reason and self._saw_the_end():
            raise RunFailed(
                f"the recording lacks {self._cycles - len(self._stamps)} of {self._cycles} cycles: "
                "the recorder was too slow, or stood still; the run was complete"
            )

    def _saw_the_end(self) -> bool:
        """In real time: whether the last cycle has come, whatever is missing before it."""
        stamps = self._stamps
        if self._lockstep or not 2 <= len(stamps) < self._cycles:
            return False
        shortest = min(b - a for a, b in pairwise(stamps))
        return stamps[-1] - stamps[0] >= (self._cycles - 1) * shortest > 0


def main() -> None:
    """Console script."""
    from fpt_ros.nodes.process import run_process

    run_process([Recorder], description.NODE, __doc__ or "")


if __name__ == "__main__":
    main()
