"""The recorder: how many messages it takes, and what it costs the graph that it records.

A node in the place of the loop publishes the four topics of TORA as fast as the recorder takes
them, each of the two on a core of its own; nothing may be lost. Then the graph runs with and
without a recorder, one after the other. On a machine that does other things too, what a message
takes of the recorder's core says more than the messages a second.
"""

import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import rclpy
from graph import measure_graph
from measure import alternate, arguments, median, show
from rclpy.executors import SingleThreadedExecutor

from fpt_ros.bags.reader import info
from fpt_ros.cycle.run import Run
from fpt_ros.experiments.experiment import load
from fpt_ros.messages.cdr import Codec
from fpt_ros.nodes.loop_node import LoopNode, message_class
from fpt_ros.nodes.qos import loop_qos
from fpt_ros.nodes.recorded_until import BEGUN, RECORDED_UNTIL, TIME, WINDOW, decode_time
from fpt_ros.nodes.stage_node import CHANGES

RECORDER = str(Path(sys.executable).with_name("recorder"))
TOPICS = ("joint_states", "state_estimate", "desired", "command")
TICK = 1_000_000
"""Nanoseconds between two cycles."""


class Feeder(LoopNode):
    """Publishes recorded cycles, never further ahead than the plant would be."""

    def __init__(self) -> None:
        super().__init__("feeder")
        loop = load("tora", duration=0.1).loop()
        cycle = [(topic, frame) for topic, frame in Run(loop).frames() if frame.stamp == 0]
        self._cycle = [(self.advertise(topic), Codec(topic), frame) for topic, frame in cycle]
        kind = message_class("rcl_interfaces/msg/ParameterEvent")
        self._changes = self.create_publisher(kind, CHANGES, 10)
        self.begun, self.until = False, -1
        self._recorded = self.create_subscription(
            message_class(TIME), RECORDED_UNTIL, self._on_recorded, loop_qos(1), raw=True
        )
        self.executor_of_it = SingleThreadedExecutor()
        self.executor_of_it.add_node(self)

    def _on_recorded(self, data: bytes) -> None:
        stamp = decode_time(data)
        if stamp == BEGUN:
            self.begun = True
        else:
            self.until = stamp // TICK

    def feed(self, cycles: int) -> float:
        """Publish so many cycles; the seconds until they were recorded."""
        while not self.begun:
            self.executor_of_it.spin_once(timeout_sec=0.1)
        take, kind = self._recorded.handle.take_message, self._recorded.msg_type
        started = time.monotonic()
        for k in range(cycles):
            for publish, codec, frame in self._cycle:
                publish(codec.encode(frame._replace(stamp=k * TICK)))
            while k - self.until >= WINDOW:
                taken = take(kind, True)
                if taken is not None:
                    self._on_recorded(taken[0])
        while self.until < cycles - 1:
            self.executor_of_it.spin_once(timeout_sec=0.1)
        return time.monotonic() - started


def rate(cycles: int) -> tuple[float, float]:
    """Messages a second, and microseconds of the recorder's processor a message."""
    os.environ["ROS_AUTOMATIC_DISCOVERY_RANGE"] = "LOCALHOST"
    cores = sorted(os.sched_getaffinity(0))
    with tempfile.TemporaryDirectory(prefix="fpt-bench-") as folder:
        bag = Path(folder) / "bag"
        given = ["--ros-args", "-p", f"directory:={bag}", "-p", f"cycles:={cycles}"]
        recorder = subprocess.Popen([RECORDER, *given])
        rclpy.init()
        feeder = Feeder()
        try:
            os.sched_setaffinity(recorder.pid, {cores[-1]})
            os.sched_setaffinity(0, {cores[0]})
            before = processor_time(recorder.pid)
            took = feeder.feed(cycles)
            spent = processor_time(recorder.pid) - before
        finally:
            os.sched_setaffinity(0, cores)
            recorder.terminate()
            recorder.wait()
            feeder.destroy_node()
            rclpy.shutdown()
        _check(bag, cycles)
    messages = len(TOPICS) * cycles
    return messages / took, 1e6 * spent / messages


def _check(bag: Path, cycles: int) -> None:
    topics: dict[str, dict[str, int]] = info(bag)["topics"]  # type: ignore[assignment]
    counts = {name: topics[f"/{name}"]["messages"] for name in TOPICS}
    if set(counts.values()) != {cycles}:
        raise RuntimeError(f"of {cycles} cycles there are {counts}")


def processor_time(pid: int) -> float:
    """Of all threads of a process so far [s]."""
    fields = Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def main() -> None:
    """Measure, and print the tables."""
    options = arguments(__doc__ or "", cycles=25_000, seconds=16.0)
    spent: list[float] = []

    def feed() -> float:
        found, each = rate(options.cycles)
        spent.append(each)
        return found

    found = median(alternate({"recorder": feed}, options.runs, options.json))
    a_message = statistics.median(spent)
    rows = [
        {
            "what": "the recorder, fed by one node",
            "messages/s": found["recorder"],
            "processor a message [us]": a_message,
            "messages/s of one core": 1e6 / a_message,
        }
    ]
    show(f"{options.cycles:,} cycles of four topics, none lost", rows, options.json)

    def graph_of(name: str, recorded: bool) -> Callable[[], float]:
        return lambda: measure_graph(name, options.seconds, False, recorded)

    graphs = {
        f"{name}{', recorded' if recorded else ''}": graph_of(name, recorded)
        for name in ("tora", "vdp_rfpt")
        for recorded in (False, True)
    }
    paces = median(alternate(graphs, options.runs, options.json))
    rows = [
        {
            "what": name,
            "cycles/s": pace,
            "cost [%]": 100 * (1 - pace / paces[name.partition(",")[0]]),
        }
        for name, pace in paces.items()
    ]
    show("The graph in lockstep, with and without a recorder", rows, options.json)


if __name__ == "__main__":
    main()
