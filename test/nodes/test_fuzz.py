"""Wild messages into each node, in process: no crash, no command beyond a limit or not finite."""

import math
from functools import cache

import pytest
import rclpy
import samples
from hypothesis import HealthCheck, Phase, given, settings
from hypothesis import strategies as st
from std_srvs.srv import Trigger

from fpt_ros.cycle.denoiser import Denoiser
from fpt_ros.cycle.parameter_tuner import ParameterTuner
from fpt_ros.cycle.trajectory_generator import TrajectoryGenerator
from fpt_ros.errors import Diverged
from fpt_ros.experiments.experiment import load
from fpt_ros.messages.cdr import Codec
from fpt_ros.messages.frames import Command
from fpt_ros.messages.topics import BY_NAME, COMMAND
from fpt_ros.nodes.fpt_deformer import DeformerNode
from fpt_ros.nodes.plant_node import PlantNode
from fpt_ros.nodes.recorder import Recorder
from fpt_ros.nodes.robot import Robot
from fpt_ros.nodes.stage_node import StageNode

JOINTS = ("q1", "q2", "q3", "gripper", "")
LIMITS = (150.0, 20.0, 50.0)
SETTINGS = (
    f"fpt_deformer.limit.effort={list(LIMITS)}",
    "fpt_deformer.anti_windup=acted",
    "fpt_deformer.take_over=0.01",
    "fpt_deformer.when_stopped=hold",
    "fpt_deformer.hold.stiffness=[1e3, 1e3, 1e3]",
    "fpt_deformer.hold.damping=[1e2, 1e2, 1e2]",
)
MESSAGES = 20
EXAMPLES = 500 if samples.whole else 15
"""Of ``MESSAGES`` each: 10,000 into each node, or a sample."""

NODES = {
    "denoiser": lambda: StageNode(Denoiser),
    "trajectory_generator": lambda: StageNode(TrajectoryGenerator),
    "parameter_tuner": lambda: StageNode(ParameterTuner),
    "fpt_deformer": DeformerNode,
    "plant_simulator": PlantNode,
    "recorder": Recorder,
}

COUNTED = []
"""Commands of each example."""

number = st.one_of(st.floats(), st.floats(-2.0, 2.0))
vector = st.one_of(st.lists(number, max_size=6), st.lists(number, min_size=3, max_size=3))
names = st.one_of(st.just(JOINTS[:3]), st.lists(st.sampled_from(JOINTS), max_size=6).map(tuple))
stamp = st.one_of(
    st.integers(-(2**31), 2**31 - 1).map(lambda s: s * 10**9),
    st.integers(0, 9).map(lambda cycle: 1_800_000_000 * 10**9 + cycle * 1_000_000),
)


@cache
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
        if name == "fpt_deformer":
            made.sent, made.bare = [], []
            made._publish = made.sent.append
            patch.setattr(made._efforts, "publish", lambda m: made.bare.append(list(m.data)))
        made.begin()
        yield made
        made.close()
        made.destroy_node()
        rclpy.try_shutdown()


EVENTS = {
    "deadline": lambda node: node.on_deadline(),
    "stop": lambda node: node._stop(True),
    "release": lambda node: node._stop(False),
    "begin again": lambda node: node._on_begin_again(None, Trigger.Response()),
}
"""Of a deformer: the loop is silent, an emergency stop, a reset; whatever was heard before."""


@cache
def steps(topics, events):
    """What happens to a node: a message each, then perhaps an event."""
    message = st.sampled_from(topics).flatmap(
        lambda topic: st.tuples(st.just(topic), encoded(BY_NAME[topic]))
    )
    event = st.sampled_from(("",) * 9 * len(events) + events) if events else st.just("")
    effort = st.lists(number, min_size=3, max_size=3)
    return st.lists(st.tuples(message, event, effort), min_size=MESSAGES, max_size=MESSAGES)


@settings(
    max_examples=EXAMPLES,
    deadline=None,
    phases=[Phase.generate],  # the node goes on from example to example: nothing shrinks
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
@given(data=st.data())
def test_no_message_breaks_a_node(node, data):
    deformer, plant = isinstance(node, DeformerNode), isinstance(node, PlantNode)
    heard = {each.topic_name[1:]: each for each in node.loop_subscriptions}
    topics = tuple(topic for topic in heard if topic in BY_NAME)
    for (topic, message), event, effort in data.draw(
        steps(topics, tuple(EVENTS) if deformer else ())
    ):
        heard[topic].callback(message, b"one")
        node.act()
        if event:
            EVENTS[event](node)
        if plant:
            let_act(node, heard["command"].callback, effort)
    if deformer:
        for efforts in (*commanded(node.sent), *node.bare):
            assert all(map(math.isfinite, efforts))
            assert all(abs(x) <= limit for x, limit in zip(efforts, LIMITS, strict=True))
        node.sent.clear()
        node.bare.clear()


def commanded(sent):
    """The efforts of the commands; these are counted: a test without any would say nothing."""
    efforts = [command.effort for command in map(Codec(COMMAND).decode, sent)]
    COUNTED.append(len(efforts))
    return efforts


def let_act(node, hear, effort):
    """A command of the cycle that is due, however large: a plant that is lost says so and ends."""
    command = Command(node._stamp, JOINTS[:3], [0.0] * 3, effort)
    hear(Codec(COMMAND).encode(command), b"one")
    try:
        node.on_deadline()
    except Diverged:
        node.stage.begin_again()


def test_commands_were_published():
    assert sum(COUNTED) > EXAMPLES
