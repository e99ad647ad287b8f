"""Reading a recording into arrays, and recording itself, beside what others need for the same.

Reading: one file of TORA (four topics a cycle), all numbers into arrays: by this package, by
rosbags, and by mcap with mcap-ros2-support. Recording: a node that publishes the loop's topics as
fast as the recorder takes them, each on a core of its own; and the graph, with and without it.
"""

import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from time import process_time
from typing import Any

import numpy as np
from measure import alternate, arguments, median, show

from fpt_ros.messages.topics import JOINT_TRAJECTORY

FPT = str(Path(sys.executable).with_name("fpt"))


def make(messages: int, folder: Path) -> Path:
    """A recording of so many messages, of an engine's run."""
    bag = folder / "tora"
    seconds = str(messages / 4 / 1000)
    command = [FPT, "simulate", "tora", "--duration", seconds, "--record", str(bag), "--json"]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return bag


def ours(bag: Path) -> dict[str, Any]:
    """Tables by topic."""
    from fpt_ros import load

    return dict(load(bag))


def by_rosbags(bag: Path) -> dict[str, Any]:
    """Arrays by topic and field."""
    from rosbags.highlevel import AnyReader

    found: dict[str, list[list[Any]]] = {}
    with AnyReader([bag]) as reader:
        for connection, stamp, raw in reader.messages():
            message = reader.deserialize(raw, connection.msgtype)
            _gather(found, connection.topic, connection.msgtype == JOINT_TRAJECTORY, stamp, message)
    return _arrays(found)


def by_mcap(bag: Path) -> dict[str, Any]:
    """Arrays by topic and field, of mcap-ros2-support."""
    from mcap_ros2.reader import read_ros2_messages

    found: dict[str, list[list[Any]]] = {}
    for item in read_ros2_messages(str(bag / "tora_0.mcap")):
        is_trajectory = item.schema.name == JOINT_TRAJECTORY
        _gather(found, item.channel.topic, is_trajectory, item.log_time_ns, item.ros_msg)
    return _arrays(found)


def _gather(
    found: dict[str, list[list[Any]]], topic: str, is_trajectory: bool, stamp: int, message: Any
) -> None:
    columns = found.setdefault(topic, [[] for _ in range(5)])
    columns[0].append(stamp)
    if is_trajectory:
        point = message.points[0]
        values = point.positions, point.velocities, point.accelerations, point.effort
    else:
        values = message.position, message.velocity, message.effort, ()
    for column, value in zip(columns[1:], values, strict=True):
        column.append(value)


def _arrays(found: dict[str, list[list[Any]]]) -> dict[str, Any]:
    return {topic: [np.array(column) for column in columns] for topic, columns in found.items()}


def seconds(read: Callable[[Path], dict[str, Any]], bag: Path) -> Callable[[], float]:
    """What a reader takes: time of the processor [s], as all of them work on one core."""

    def measure() -> float:
        started = process_time()
        if len(read(bag)) != 4:
            raise RuntimeError("topics are missing")
        return process_time() - started

    return measure


def main() -> None:
    """Measure, and print the tables."""
    options = arguments(__doc__ or "", messages=1_000_000)
    with tempfile.TemporaryDirectory(prefix="fpt-bench-") as folder:
        bag = make(options.messages, Path(folder))
        readers = {"fpt_ros.load": ours, "rosbags": by_rosbags, "mcap-ros2-support": by_mcap}
        small = make(400, Path(folder) / "small")
        for read in readers.values():  # what is imported first
            read(small)
        measurements = {name: seconds(read, bag) for name, read in readers.items()}
        found = median(alternate(measurements, options.runs, options.json))
    rows = [
        {
            "reader": name,
            "seconds": took,
            "messages/s": options.messages / took,
            "times slower than ours": took / found["fpt_ros.load"],
        }
        for name, took in found.items()
    ]
    show(f"{options.messages:,} messages into arrays", rows, options.json)


if __name__ == "__main__":
    main()
