"""The graph over DDS against an echo ring on rclpy's default executor.

The ring: a JointState of six doubles goes round five nodes, each of which builds the message that
it passes on from the one that came; reliable and latched as the loop's topics are. Its rounds a
second are what five hops cost an ordinary rclpy program. The graph's cycle has four hops one after
the other (five with a tuner that needs the desired response), with the laws inside and fan-out.
"""

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from measure import alternate, arguments, median, show

HOPS = 5
RING_SECONDS = 6.0
COUNTED_FROM = 0.2
"""Part of a run that passes before its pace is taken."""


def ring_node(index: int, rounds: dict[str, float]) -> object:
    """Node ``index`` of the ring; node 0 counts rounds and keeps the message going."""
    from rclpy.node import Node
    from rclpy.qos import DurabilityPolicy, HistoryPolicy, QoSProfile, ReliabilityPolicy
    from sensor_msgs.msg import JointState

    qos = QoSProfile(
        history=HistoryPolicy.KEEP_LAST,
        depth=64,
        reliability=ReliabilityPolicy.RELIABLE,
        durability=DurabilityPolicy.TRANSIENT_LOCAL,
    )
    node = Node(f"echo_{index}")
    publisher = node.create_publisher(JointState, f"hop_{(index + 1) % HOPS}", qos)

    def on_message(message: JointState) -> None:
        answer = JointState()
        answer.header.stamp = message.header.stamp
        answer.name = message.name
        answer.position = message.position
        answer.velocity = message.velocity
        if index == 0:
            rounds.setdefault("from", time.monotonic())
            rounds["to"] = time.monotonic()
            rounds["count"] = rounds.get("count", 0) + 1
        publisher.publish(answer)

    node.create_subscription(JointState, f"hop_{index}", on_message, qos)
    if index == 0:
        first = JointState(name=["q1", "q2", "q3"], position=[0.1] * 3, velocity=[0.2] * 3)
        publisher.publish(first)
    return node


def ring(indices: list[int], seconds: float) -> None:
    """Process with some nodes of the ring; the one with node 0 prints rounds a second."""
    import rclpy
    from rclpy.executors import SingleThreadedExecutor

    rclpy.init()
    rounds: dict[str, float] = {}
    executor = SingleThreadedExecutor()
    nodes = [ring_node(i, rounds) for i in reversed(indices)]
    for node in nodes:
        executor.add_node(node)  # type: ignore[arg-type]
    while "from" not in rounds or time.monotonic() - rounds["from"] < seconds:
        executor.spin_once(timeout_sec=0.2)
        if 0 not in indices and os.getppid() == 1:
            break
    print((rounds["count"] - 1) / (rounds["to"] - rounds["from"]), flush=True)


def measure_ring(composed: bool) -> float:
    """Rounds a second of a ring in one process or in five."""
    groups = [list(range(HOPS))] if composed else [[i] for i in range(HOPS)]
    children = [
        subprocess.Popen(
            [sys.executable, __file__, "ring", ",".join(map(str, group))],
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            env={**os.environ, "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST"},
            text=True,
        )
        for group in groups
    ]
    try:
        output, _ = children[0].communicate(timeout=120)
    finally:
        for child in children:
            child.kill()
            child.wait()
    return float(output)


def measure_graph(name: str, seconds: float, composed: bool, recorded: bool) -> float:
    """Cycles a second, the first part of the run (discovery) not counted."""
    from fpt_ros.experiments.experiment import load
    from fpt_ros.nodes import graph
    from fpt_ros.nodes.nursery import Nursery

    experiment = load(name).with_values("plant_simulator", duration=seconds)
    total = experiment.loop().plant.cycles
    pace: list[tuple[float, int]] = []

    def progress(done: int) -> None:
        if done > COUNTED_FROM * total:
            pace.append((time.monotonic(), done))

    with tempfile.TemporaryDirectory(prefix="fpt-bench-") as folder, Nursery() as nursery:
        bag = Path(folder) / "bag" if recorded else None
        graph.run(nursery, experiment, bag, composed=composed, progress=progress)
    return (pace[-1][1] - pace[0][1]) / (pace[-1][0] - pace[0][0])


def main() -> None:
    """Measure, and print the table."""
    options = arguments(__doc__ or "", seconds=1.0)
    scale = options.seconds

    def graph_of(name: str, seconds: float, composed: bool, recorded: bool) -> Callable[[], float]:
        return lambda: measure_graph(name, seconds * scale, composed, recorded)

    separate = {
        "five-process echo ring": lambda: measure_ring(False),
        "tora": graph_of("tora", 16.0, False, False),
        "tora, recorded": graph_of("tora", 16.0, False, True),
        "vdp_rfpt": graph_of("vdp_rfpt", 16.0, False, False),
        "vdp_rfpt, recorded": graph_of("vdp_rfpt", 16.0, False, True),
    }
    composed = {
        "composed echo ring": lambda: measure_ring(True),
        "tora --composed": graph_of("tora", 80.0, True, False),
        "vdp_rfpt --composed": graph_of("vdp_rfpt", 80.0, True, False),
    }
    rows = []
    for group in (separate, composed):
        base = next(iter(group))
        found = median(alternate(group, options.runs, options.json))
        rows += [
            {"what": name, "rounds/s": rate, "ratio to its ring": rate / found[base]}
            for name, rate in found.items()
        ]
    show("The graph in lockstep against an echo ring", rows, options.json)


if __name__ == "__main__":
    if sys.argv[1:2] == ["ring"]:
        ring([int(i) for i in sys.argv[2].split(",")], RING_SECONDS)
    else:
        main()
