"""Parameters through ROS, while the loop runs."""

import signal

import numpy as np
from command import forked_fpt_json as fpt_json
from command import start_fpt
from engine_runs import stage_by_stage
from frames_collected import Collector
from mcap_ros2.reader import read_ros2_messages
from watcher import watcher

from fpt_ros.bags.reader import read_run
from fpt_ros.experiments import experiment
from fpt_ros.messages.topics import DESIRED

LONG = 1000


def interrupted(process, bag):
    """End a run; the number of its recorded cycles."""
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)
    assert process.returncode == 130
    return len(read_run(bag).topics["command"].stamps)


def same_efforts(ours, theirs):
    assert len(ours.stamps) > 500
    assert np.array_equal(ours.vectors["effort"], theirs.vectors["effort"])


def test_changes_take_effect_at_a_cycle_and_are_recorded_with_its_stamp(tmp_path):
    bag = tmp_path / "bag"
    process = start_fpt("run", "tora", "--duration", LONG, "--record", bag)
    with watcher() as graph:
        graph.wait_for_stamp(0.5)
        assert graph.set_parameter("fpt_deformer", "A", -0.2) == (True, "")
        assert graph.get_parameter("fpt_deformer", "A") == -0.2
        assert graph.set_parameter("fpt_deformer", "approximate.m", 11.0)[0]
        graph.wait_for_next()
    cycles = interrupted(process, bag)

    changes = {}
    for each in read_ros2_messages(bag / "bag_0.mcap", topics=["/parameter_changes"]):
        stamp = each.ros_msg.stamp.sec * 10**9 + each.ros_msg.stamp.nanosec
        for changed in each.ros_msg.changed_parameters:
            changes.setdefault(stamp, {})[changed.name] = changed.value.double_value
    assert sorted(name for change in changes.values() for name in change) == ["A", "approximate.m"]

    # the engine with the same changes at the same cycles gives the same bits
    loop, collector = experiment.load("tora", duration=cycles / 1000).loop(), Collector()

    def observe(topic, frame):
        collector(topic, frame)
        if topic == DESIRED and frame.stamp in changes:
            loop.deformer.configure(changes[frame.stamp])

    stage_by_stage(loop, observe)
    same_efforts(collector.topics()["command"], read_run(bag).topics["command"])


def test_bad_values_are_refused_with_a_reason_and_the_run_is_unharmed(tmp_path):
    bag = tmp_path / "bag"
    process = start_fpt("run", "tora", "--duration", LONG, "--record", bag)
    with watcher() as graph:
        graph.wait_for_stamp(0.2)
        refused = [
            ("fpt_deformer", "K", -1.0, "range"),
            ("fpt_deformer", "K", 1.99, "fixed point"),
            ("fpt_deformer", "A", float("nan"), "A"),
            ("fpt_deformer", "A", "strong", "type"),
            ("fpt_deformer", "transformation", "none", "read-only"),
            ("trajectory_generator", "amplitude", [0.1], "2 needed"),
            ("trajectory_generator", "lambda", 0.0, "lambda"),
            ("plant_simulator", "dt", 0.5, "read-only"),
        ]
        for node, name, value, reason in refused:
            successful, why = graph.set_parameter(node, name, value)
            assert not successful, name
            assert reason in why, (name, why)
        assert graph.get_parameter("fpt_deformer", "K") == 0.5
        graph.wait_for_next()
        graph.wait_for_stamp(0.6)
    cycles = interrupted(process, bag)
    engine_bag = tmp_path / "engine"
    fpt_json("simulate", "tora", "--duration", cycles / 1000, "--record", engine_bag)
    same_efforts(read_run(engine_bag).topics["command"], read_run(bag).topics["command"])
