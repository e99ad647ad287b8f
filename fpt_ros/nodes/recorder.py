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
from collections.abc import Callable
from time import time_ns

from diagnostic_msgs.msg import DiagnosticStatus
from rclpy.qos import DurabilityPolicy
from rclpy.subscription import Subscription

from fpt_ros import __version__
from fpt_ros.bags.split import Split
from fpt_ros.bags.writer import BagWriter
from fpt_ros.cycle.arrivals import Arrivals
from fpt_ros.cycle.turns import Turns
from fpt_ros.errors import RunFailed
from fpt_ros.experiments import description
from fpt_ros.messages.cdr import Codec, MalformedMessage
from fpt_ros.messages.frames import SECOND
from fpt_ros.messages.topics import DEPTH, JOINT_STATES, LOOP_TOPICS, TUNING, Topic
from fpt_ros.nodes import run_folder
from fpt_ros.nodes.loop_node import LoopNode, message_class
from fpt_ros.nodes.moderation import Moderation
from fpt_ros.nodes.qos import HEARD, loop_qos, sensor_qos
from fpt_ros.nodes.recorded_cycles import RecordedCycles
from fpt_ros.nodes.recorded_run import last_change, reason_to_end, recorded_run
from fpt_ros.nodes.recorded_until import BEGUN, RECORDED_UNTIL, TIME, WINDOW, encode_time
from fpt_ros.nodes.ros_parameters import declare
from fpt_ros.nodes.run_over import end_with_plant
from fpt_ros.nodes.side_topics import ROSOUT, SIDE_DEPTH, SIDE_TOPICS
from fpt_ros.nodes.snapshot import Snapshot
from fpt_ros.nodes.stage_node import CHANGES
from fpt_ros.nodes.take import gid_of
from fpt_ros.parameters import integer, word

ACKNOWLEDGE = 8
"""Cycles between two messages to the plant."""

NICE = 10
"""In real time the loop comes first: misses with a recorder were down by a third to a half."""

OPENED, STARTED = "recorder.opened", "recorder.started"
"""Steps that a recorder started in the place of another finds taken."""

Message = tuple[str, str, int, bytes]  # name and type of the topic, stamp [ns], bytes

_STAMP = struct.Struct("<iI")


class Recorder(LoopNode):
    """Subscribes to every topic of the graph and writes a rosbag2 directory."""

    def __init__(self) -> None:
        super().__init__(description.NODE)
        values = declare(self, description.parameters)
        end_with_plant(self, values)
        self._lockstep = values.get("realtime") is not True
        self._robot = values.get("robot") is True
        self._cycles = integer(values, "cycles")
        run = recorded_run(values)
        self._known = run.parameters
        self._said_before = run_folder.mark(OPENED) and last_change(run.directory)
        self._writer = BagWriter(
            run.directory,
            self._known,
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
            again=bool(self._said_before),
        )
        self._lost: RunFailed | None = None
        self._snapshot: Snapshot | None = None
        self._started, self._acknowledged = False, 0
        self._side_subscriptions: list[tuple[Subscription, Callable[[bytes], None]]] = []
        self._until = self.create_publisher(message_class(TIME), RECORDED_UNTIL, loop_qos(1))
        until = self.resolve_topic_name(RECORDED_UNTIL)
        run_folder.introduce(until, gid_of(self._until))
        tuned = values.get("await_tuning") is True
        topics = [topic for topic in LOOP_TOPICS if tuned or topic != TUNING]
        before = [self._writer.stamps.pop(self.resolve_topic_name(t.name), []) for t in topics]
        self._recorded = RecordedCycles(self._lockstep, before)
        self._turns = Turns[Message](len(topics), sum(self._recorded.counts))
        for index, topic in enumerate(topics):
            self._record_loop_topic(index, topic)
        self._moderation: Moderation | None = None
        self._slept = 0
        for name, kind in SIDE_TOPICS.items():
            self._record_side_topic(name, kind)
        if run_folder.is_marked(STARTED):
            self.get_logger().warning(f"started again: {self._recorded.done} cycles are recorded")
            self._started = True
            self._acknowledge()

    def _record_loop_topic(self, index: int, topic: Topic) -> None:
        name, kind = topic.name, topic.type
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
                f"the recording ends after {self._recorded.done} cycles, the run went on: {error}"
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
        write, recorded = self._write, self._recorded
        arrivals = Arrivals() if self._robot and topic is JOINT_STATES else None
        name, kind, decode = self.resolve_topic_name(topic.name), topic.type, Codec(topic).decode

        def record(data: bytes) -> bool:
            try:
                stamp = _stamp_of(data)
                if arrivals is not None:
                    stamp = arrivals.stamp(stamp, time_ns())
                if recorded.is_unexpected(index, stamp):
                    decode(data)
                if stamp < 0:
                    raise MalformedMessage
            except (struct.error, MalformedMessage):
                self.ignore(f"{name}: {len(data)} bytes that are not a {kind}")
                return False
            if not recorded.is_next(index, stamp, name):
                return False
            if self._lockstep:
                for message in self._turns.add(index, (name, kind, stamp, data)):
                    write(*message)
            else:
                write(name, kind, stamp, data)
            if recorded.done >= self._acknowledged + ACKNOWLEDGE:
                self._acknowledge()
            return True

        return record

    def _acknowledge(self) -> None:
        done = self._recorded.done
        if self._started and done > self._acknowledged:
            self._acknowledged = self.cycles_done = done
            self._until.publish(encode_time(self._recorded.until))

    def nap(self) -> None:
        """Let messages gather, but where so many came that the plant may wait for us."""
        done = self._recorded.done
        if self._moderation is not None and done - self._slept < WINDOW // 2:
            self._moderation.nap()
        self._slept = done

    def _record_side_topic(self, name: str, kind: str) -> None:
        resolved = self.resolve_topic_name(name)
        self._writer.add_topic(resolved, kind)

        def record(data: bytes) -> None:
            if name == ROSOUT and _stamp_of(data) <= self._said_before:
                return
            begun = self._lockstep or self._recorded.cycles > 0  # else no cycle tells the time yet
            self._write(resolved, kind, self._recorded.newest if begun else time_ns(), data)

        # what was said before we came is recorded too
        qos = loop_qos(SIDE_DEPTH) if name in (ROSOUT, CHANGES) else SIDE_DEPTH
        subscription = self.create_subscription(message_class(kind), name, record, qos, raw=True)
        self._side_subscriptions.append((subscription, record))
        if name == CHANGES:
            self._changes = subscription

    def begin(self) -> None:
        """The loop comes first."""
        self._moderation = Moderation(self.loop_subscriptions)
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
                self._snapshot, self.awaits_answers = Snapshot(self, names), True
            return
        if not self._snapshot.is_done():
            return
        self.awaits_answers = False
        for name, values in self._snapshot.parameters.items():
            self._known[name] = {**self._known.get(name, {}), **values}
        for problem in self._snapshot.problems:
            self.get_logger().warning(problem)
        if self._lost is None:
            self._writer.set_parameters(self._known)
        self._started = True
        run_folder.mark(STARTED)
        self._until.publish(encode_time(BEGUN))

    def _matched(self) -> bool:
        """Whether it hears all nodes: each loop topic, and all changes of parameters."""
        heard = all(each.get_publisher_count() for each in self.loop_subscriptions)
        changing = [
            each
            for each in self.get_publishers_info_by_topic(CHANGES)
            if each.qos_profile.durability == DurabilityPolicy.TRANSIENT_LOCAL
        ]
        return heard and self._changes.get_publisher_count() >= len(changing)

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
                if (taken := subscription.handle.take_message(subscription.msg_type, True)) is None:
                    break
                record(taken[0])

    def close(self) -> None:
        """Finish the file; say why, if the run did not end by itself.

        Raises:
            RunFailed: the recording could not be written to the end.
        """
        if self._moderation is not None:
            self._moderation.close()
        self._take_what_has_come()
        for message in self._turns.rest():
            self._write(*message)
        reason = reason_to_end() or str(sys.exc_info()[1] or "")
        if self._lost is not None:
            raise self._lost
        done = self._recorded.cycles
        if not reason and done < self._cycles:
            reason = f"the recorder was stopped after {done} of {self._cycles} cycles"
        if not reason and self._recorded.is_within_a_cycle:
            reason = "the recorder was stopped in the middle of a cycle"
        self._writer.close(reason)
        if reason and self._recorded.saw_the_end(self._cycles):
            raise RunFailed(
                f"the recording lacks {self._cycles - done} of {self._cycles} cycles: "
                "the recorder was too slow, or stood still; the run was complete"
            )


def _stamp_of(data: bytes) -> int:
    """The time [ns] in front of a message.

    Raises:
        struct.error: there is none.
    """
    seconds, nanoseconds = _STAMP.unpack_from(data, 4)
    return int(seconds) * SECOND + int(nanoseconds)


def main() -> None:
    """Console script."""
    from fpt_ros.nodes.process import run_process

    run_process([Recorder], description.NODE, __doc__ or "")


if __name__ == "__main__":
    main()
