"""Wild messages into each node, in process: no crash, no command beyond a limit or not finite."""

import math

import pytest
import rclpy
import samples
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from fpt_ros.cycle.denoiser import Denoiser
from fpt_ros.cycle.parameter_tuner import ParameterTuner
from fpt_ros.cycle.trajectory_generator import TrajectoryGenerator
from fpt_ros.experiments.experiment import load
from fpt_ros.messages.cdr import Codec
from fpt_ros.messages.topics import BY_NAME, COMMAND
from fpt_ros.nodes.fpt_deformer import DeformerNode
from fpt_ros.nodes.plant_node import PlantNode
from fpt_ros.nodes.recorder import Recorder
from fpt_ros.nodes.robot import Robot
from fpt_ros.nodes.stage_node import StageNode

JOINTS = ("q1", "q2", "q3", "gripper", "")
LIMITS = (150.0, 20.0, 50.0)
SETTINGS = (f"fpt_deformer.limit.effort={list(LIMITS)}", "fpt_deformer.anti_windup=acted")
MESSAGES = 20
EXAMPLES = 500 if samples.whole else 40
"""Of ``MESSAGES`` each: 10,000 into each node, or a sample."""

NODES = {
    "denoiser": lambda: StageNode(Denoiser),
    "trajectory_generator": lambda: StageNode(TrajectoryGenerator),
    "parameter_tuner": lambda: StageNode(ParameterTuner),
    "fpt_deformer": DeformerNode,
    "plant_simulator": PlantNode,
    "recorder": Recorder,
}

number = st.one_of(st.floats(), st.floats(-2.0, 2.0))
vector = st.one_of(st.lists(number, max_size=6), st.lists(number, min_size=3, max_size=3))
names = st.one_of(st.just(JOINTS[:3]), st.lists(st.sampled_from(JOINTS), max_size=6).map(tuple))
stamp = st.one_of(
    st.integers(-(2**31), 2**31 - 1).map(lambda s: s * 10**9),
    st.integers(0, 50).map(lambda cycle: 1_800_000_000 * 10**9 + cycle * 1_000_000),
)


def encoded(topic):
    """A message of a topic, wild or nearly right, or mere bytes."""

    def build(at, who, vectors):
        return Codec(topic).encode(topic.frame(at, who, *vectors))

    count = len(topic.vectors)
    wild = st.builds(build, stamp, names, st.lists(vector, min_size=count, max_size=count))
    right = st.builds(
        build,
        stamp,
        st.just(JOINTS[:3]),
        st.lists(
            st.lists(st.floats(-2.0, 2.0), min_size=3, max_size=3), min_size=count, max_size=count
        ),
    )
    return st.one_of(wild, right, st.binary(max_size=200))


@pytest.fixture(scope="module", params=list(NODES))
def node(request, tmp_path_factory):
    """One node of a robot's controller, real but for its publisher, which keeps what it gets."""
    name = request.param
    experiment = "tora_auto" if name == "parameter_tuner" else "tora"
    own = SETTINGS if name == "fpt_deformer" else ()
    loaded = Robot().experiment(load(experiment, settings=own).for_graph(realtime=True))
    folder = tmp_path_factory.mktemp(name)
    file = folder / "parameters.yaml"
    loaded.with_values("recorder", directory=str(folder / "bag")).write(file)
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROS_DOMAIN_ID", "101")
        patch.setattr("sys.argv", ["node"])
        rclpy.init(args=["--ros-args", "--params-file", str(file), "--log-level", "fatal"])
        made = NODES[name]()
        yield made
        made.close()
        made.destroy_node()
        rclpy.try_shutdown()


@settings(
    max_examples=EXAMPLES,
    deadline=None,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
@given(data=st.data())
def test_no_message_breaks_a_node(node, data):
    decode, sent = Codec(COMMAND).decode, []
    is_deformer = isinstance(node, DeformerNode)
    if is_deformer:
        node._publish = sent.append
    topics = [each for each in node.loop_subscriptions if each.topic_name[1:] in BY_NAME]
    for _ in range(MESSAGES):
        subscription = data.draw(st.sampled_from(topics))
        message = data.draw(encoded(BY_NAME[subscription.topic_name[1:]]))
        subscription.callback(message, b"one")
        node.act()
    for command in map(decode, sent):
        for effort, limit in zip(command.effort, LIMITS, strict=True):
            assert math.isfinite(effort)
            assert abs(effort) <= limit
