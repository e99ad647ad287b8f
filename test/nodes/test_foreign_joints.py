"""Each node alone, its inputs from somebody else: other order, more joints, empty arrays."""

import math
import subprocess
from contextlib import contextmanager

import pytest
import rclpy
from command import BIN
from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from stranger import kinds

from fpt_ros.cycle.run import Run
from fpt_ros.experiments.experiment import load
from fpt_ros.messages.cdr import Codec
from fpt_ros.nodes.loop_node import message_class
from fpt_ros.nodes.qos import loop_qos

CYCLES = 60
PATIENCE = 60.0


class Peer:
    """Publishes what one node needs, and takes its answers."""

    def __init__(self, context, stage, namespace):
        self.node = rclpy.create_node("peer", namespace=namespace, context=context)
        self.executor = SingleThreadedExecutor(context=context)
        self.executor.add_node(self.node)
        self.stage, self.answers = stage, []
        decode = Codec(stage.output).decode
        kind = message_class(stage.output.type)
        self.node.create_subscription(
            kind,
            stage.output.name,
            lambda data: self.answers.append(decode(data)),
            loop_qos(),
            raw=True,
        )
        self.publishers = {
            each.topic: self.node.create_publisher(
                message_class(each.topic.type), each.topic.name, loop_qos()
            )
            for each in stage.inputs
        }

    def send(self, topic, frame):
        self.publishers[topic].publish(Codec(topic).encode(frame))

    def answer(self, stamp):
        """The node's answer of a cycle."""
        deadline = self.node.get_clock().now().nanoseconds + PATIENCE * 1e9
        while not (self.answers and self.answers[-1].stamp == stamp):
            self.executor.spin_once(timeout_sec=1.0)
            assert self.node.get_clock().now().nanoseconds < deadline, "the node gives no answer"
        return self.answers[-1]

    def matched(self):
        """Wait until the node listens and is listened to."""
        deadline = self.node.get_clock().now().nanoseconds + PATIENCE * 1e9
        while not all(each.get_subscription_count() for each in self.publishers.values()):
            self.executor.spin_once(timeout_sec=0.05)
            assert self.node.get_clock().now().nanoseconds < deadline, "the node does not listen"


@contextmanager
def node_of(stage, file):
    """The node of a stage as a process, and a peer in its namespace."""
    namespace = f"/alone_{stage.name}"
    arguments = ["--ros-args", "--params-file", file, "-r", f"__ns:={namespace}"]
    context = Context()
    rclpy.init(context=context)
    process = subprocess.Popen(
        [BIN / stage.name, *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    peer = Peer(context, stage, namespace)
    try:
        peer.matched()
        yield peer
    finally:
        process.terminate()
        peer.said = process.communicate(timeout=20)[0]
        peer.executor.shutdown()
        peer.node.destroy_node()
        context.try_shutdown()


def turned(frame):
    """The same frame with its joints in another order, and joints that nobody asked for."""
    names = ("gripper", *reversed(frame.names), "wrist")
    vectors = [[99.0, *reversed(vector), -99.0] for vector in frame[2:]]
    return type(frame)(frame.stamp, names, *vectors)


def without_velocity(frame):
    """A JointState as many sensors send it: no velocity where none is measured, no effort."""
    empty = () if all(map(math.isnan, frame.velocity)) else frame.velocity
    return frame._replace(velocity=empty, effort=())


def bits(frame):
    return [[math.nan if x != x else x.hex() for x in map(float, each)] for each in frame[2:]]


def same(found, expected):
    return repr(bits(found)) == repr(bits(expected))


@pytest.mark.parametrize(
    ("experiment", "stage"),
    [
        ("noisy_tora", "denoiser"),
        ("tora", "trajectory_generator"),
        ("tora_auto", "parameter_tuner"),
        ("tora_auto", "fpt_deformer"),
    ],
)
def test_a_node_meets_the_right_joints_whatever_their_order(tmp_path, experiment, stage):
    loaded = load(experiment, duration=CYCLES * 1e-3)
    file = tmp_path / "parameters.yaml"
    loaded.for_graph(realtime=False).write(file)
    loop = loaded.loop()
    asked = next(each for each in loop.stages() if each.name == stage)
    frames = list(Run(loop).frames())
    expected = {frame.stamp: frame for topic, frame in frames if topic is asked.output}
    with node_of(asked, file) as peer:
        for stamp in sorted(expected):
            for topic, frame in frames:
                if topic not in peer.publishers:
                    continue
                lag = next(each.lag for each in asked.inputs if each.topic is topic)
                if frame.stamp == stamp - lag * loop.plant.cycle_time:
                    plain = without_velocity(frame) if topic.name == "joint_states" else frame
                    is_tuning = topic.name == "tuning"  # numbers of parameters, not of joints
                    peer.send(topic, plain if is_tuning else turned_where_given(plain))
            assert same(peer.answer(stamp), expected[stamp]), f"at {stamp} ns"


def turned_where_given(frame):
    """Turn the vectors that are there; those that a sender leaves out stay empty."""
    given = frame._replace(
        **{
            field: [0.0] * len(frame.names)
            for field in frame._fields[2:]
            if not len(getattr(frame, field))
        }
    )
    empty = {field: () for field in frame._fields[2:] if not len(getattr(frame, field))}
    return turned(given)._replace(**empty)


UNUSABLE = (
    "nan", "infinite", "huge", "short", "long", "without numbers", "empty", "unknown joint",
    "named twice", "4 bytes", "5 bytes", "12 bytes", "60 bytes", "2000 bytes", "cut",
)  # fmt: skip


def test_what_cannot_be_used_is_named_and_ignored_also_from_the_right_sender(tmp_path):
    """Bad content before each good message: the numbers stay those of the engine."""
    loaded = load("tora", duration=5e-3)
    file = tmp_path / "parameters.yaml"
    loaded.for_graph(realtime=False).write(file)
    loop = loaded.loop()
    frames = list(Run(loop).frames())
    expected = [frame for topic, frame in frames if topic is loop.deformer.output]
    with node_of(loop.deformer, file) as peer:
        for answer in expected:
            for topic, frame in frames:
                if topic in peer.publishers and frame.stamp == answer.stamp:
                    wrong = kinds(topic, frame.stamp)
                    for name in UNUSABLE:
                        peer.publishers[topic].publish(wrong[name])
                    peer.send(topic, frame)
            assert same(peer.answer(answer.stamp), answer), f"at {answer.stamp} ns"
    for text in (
        "state_estimate: positions of q1 is nan",
        "desired: positions of q1 is inf",
        "state_estimate: positions of q1 is 1e+300",
        "positions holds 1 numbers for 3 joints",
        "the joint 'q1' is not there, only wheel, gripper, q9",
        "the joint 'q1' is named twice",
        "bytes are not a trajectory_msgs/msg/JointTrajectory",
    ):
        assert text in peer.said, text
