"""A motion that another node publishes: followed, recorded, run again with the same bits."""

import signal

import numpy as np
import pytest
import rclpy
import samples
from command import forked_fpt, start_fpt
from mcap_ros2.reader import read_ros2_messages
from rcl_interfaces.msg import Log
from sensor_msgs.msg import JointState
from trajectory_msgs.msg import JointTrajectory, JointTrajectoryPoint
from watcher import PATIENCE, watcher

from fpt_ros.bags.reader import read_run
from fpt_ros.nodes.qos import loop_qos

TOPIC = "/nominal_motion"


def publish_until(graph, publisher, messages, followed):
    """Say each once, when somebody listens; wait until a desired motion fits."""
    seen = rclpy.task.Future(executor=graph.executor)

    def on_desired(desired):
        (point,) = desired.points
        if followed(point.positions[0], point.velocities[0]) and not seen.done():
            seen.set_result(True)

    subscription = graph.node.create_subscription(
        JointTrajectory, "/desired", on_desired, loop_qos(1)
    )
    while not publisher.get_subscription_count():
        graph.executor.spin_once(timeout_sec=0.1)
    for message in messages:
        publisher.publish(message)
    graph.executor.spin_until_future_complete(seen, timeout_sec=PATIENCE)
    graph.node.destroy_subscription(subscription)
    assert seen.done(), "the motion is not followed"


def trajectory(names, positions, velocities=()):
    point = JointTrajectoryPoint(positions=positions, velocities=list(velocities))
    return JointTrajectory(joint_names=names, points=[point])


@pytest.mark.parametrize("kind", ["JointTrajectory", "JointState"][: 2 if samples.whole else 1])
def test_a_live_motion(tmp_path, kind):
    bag = tmp_path / "bag"
    settings = (f"message={kind}", "hold_after=0.2")
    options = [word for one in settings for word in ("--set", f"trajectory_generator.{one}")]
    process = start_fpt(
        *("run", "duffing", "--variant", "live", "--duration", 100, *options, "--record", bag)
    )
    said = [""]
    with watcher() as graph:
        graph.node.create_subscription(Log, "/rosout", lambda log: said.append(log.msg), 10)
        graph.wait_for_stamp(0.3)  # by then it is told that nobody publishes
        if kind == "JointState":
            publisher = graph.node.create_publisher(JointState, TOPIC, 1)
            first = JointState(name=["other", "q1"], position=[9.0, 0.25], velocity=[0.0, 0.5])
            second = JointState(name=["q1"], position=[-0.1])
            bad = JointState(name=["q2"], position=[1.0])
        else:
            publisher = graph.node.create_publisher(JointTrajectory, TOPIC, 1)
            first = trajectory(["other", "q1"], [9.0, 0.25], [0.0, 0.5])
            second = trajectory(["q1"], [-0.1])
            bad = trajectory(["q2"], [1.0])
        publish_until(graph, publisher, [first], lambda q, v: abs(q - 0.35) < 1e-6 and v == 0.0)
        publish_until(graph, publisher, [bad], lambda q, v: "no joint 'q1'" in " ".join(said))
        publish_until(graph, publisher, [second], lambda q, v: q == -0.1)
        graph.wait_for_next()
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=120)
    assert process.returncode == 130
    recorded = read_ros2_messages(bag / "bag_0.mcap", topics=["/rosout"])
    said = [message.ros_msg.msg for message in recorded]
    rests = "the motion rests where it is, until a message comes"
    assert said.count(f"nobody publishes nominal_motion: {rests}") == 1
    assert said.count("ignored: nominal_motion: no joint 'q1' among q2") == 1

    desired = read_run(bag).topics["desired"]
    q, v = desired.column("positions", "q1"), desired.column("velocities", "q1")
    begin = int(np.argmax(q == 0.25))
    assert (q[:begin] == 0.0).all()
    age = 1e-3 * np.arange(200)
    assert q[begin : begin + 200] == pytest.approx(0.25 + 0.5 * age, abs=1e-9)
    assert (v[begin : begin + 200] == 0.5).all()

    for command in (("rerun", bag), ("replay", bag, "--node", "trajectory_generator")):
        done = forked_fpt(*command)
        assert done.returncode == 0, done.stderr
