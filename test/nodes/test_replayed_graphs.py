"""Graphs over DDS, with changes in flight, run again from their recordings alone."""

import math
import signal

import numpy as np
import pytest
import samples
from command import fpt, fpt_json, node_of, start_fpt
from trajectory_msgs.msg import JointTrajectory
from watcher import watcher

from fpt_ros.bags.reader import read_run
from fpt_ros.nodes.qos import loop_qos
from fpt_ros.replay.recorded import Recorded
from fpt_ros.replay.replayed import Replay
from fpt_ros.replay.rerun import rerun

LONG = 1000

CHANGES = {
    "cart_beam_hamper": ("fpt_deformer", "A", 2e-8, "strong", 0.01),
    "noisy_tora": ("fpt_deformer", "A", -0.15, float("nan"), 0.1),
    "tora": ("fpt_deformer", "A", -0.2, float("inf"), 0.1),
    "vdp_rfpt": ("parameter_tuner", "alpha", 1.5, float("nan"), 0.1),
}
"""Node, parameter, a good value, a bad one, and the time [s] at which they are set."""


def recorded_with_changes(bag, name, *options):
    """A run in which a gain is changed and a value refused; the cycle of the change."""
    node, parameter, good, bad, when = CHANGES[name]
    process = start_fpt("run", name, "--duration", LONG, "--record", bag, *options)
    with watcher() as graph:
        graph.wait_for_stamp(when)
        assert graph.set_parameter(node, parameter, good) == (True, "")
        assert not graph.set_parameter(node, parameter, bad)[0]
        graph.wait_for_next()
    process.send_signal(signal.SIGINT)
    stderr = process.communicate(timeout=60)[1]
    assert process.returncode == 130, stderr
    recorded = Recorded(bag)
    (change,) = recorded.changes
    assert change.values == {parameter: good}
    return recorded, change.stamp // recorded.cycle_time


@pytest.mark.parametrize("name", samples.sample(sorted(CHANGES), 1))
def test_every_node_and_the_whole_run_are_equal_to_the_last_bit(tmp_path, name):
    recorded, cycle = recorded_with_changes(tmp_path / "bag", name)
    assert len(recorded.nodes) >= 4
    for node in recorded.nodes:
        found = Replay(recorded, node).run()
        assert found.first is None, node
        assert found.cycles > cycle
    (whole,) = rerun(recorded).values()
    assert whole.first is None
    assert whole.cycles > cycle
    node, parameter, good, _, _ = CHANGES[name]
    without = Replay(recorded.with_settings({node: {parameter: good}}), node).run()
    assert without.first is not None  # the change was not in force from the start
    assert 0 < without.first.cycle < cycle
    (other,) = rerun(recorded.with_settings({node: {parameter: good}})).values()
    assert other.first == without.first


@pytest.mark.parametrize("options", [("--realtime",), ("--realtime", "--composed")])
def test_a_run_in_real_time_node_by_node(tmp_path, options):
    # four seconds at 250 cycles/s: half a one can pass on a busy machine before a node runs
    common = ("vdp_rfpt", "--duration", 1.0, "--set", "plant_simulator.speed=0.25", *options)
    done = fpt("run", *common, "--record", tmp_path / "bag", "--namespace", "r1")
    assert done.returncode == 0, done.stderr
    found = fpt_json("rerun", tmp_path / "bag")
    assert found["equal"] is True
    assert sorted(found["parts"]) == sorted(Recorded(tmp_path / "bag").nodes)
    assert all(part["cycles"] > 10 for part in found["parts"].values())


def test_a_run_in_real_time_whose_plant_stood_still(tmp_path):
    """What the deformer says meanwhile by itself lies before what it answers afterwards."""
    bag = tmp_path / "bag"
    process = start_fpt(
        "run", "vdp_rfpt", "--duration", 1.5, "--speed", 0.25, "--record", bag,
        "--set", "fpt_deformer.command_timeout=0.05",
    )  # fmt: skip
    with watcher() as graph:
        graph.wait_for_next()
        plant = node_of(process, "plant_simulator")
        plant.suspend()
        wait_for_safe_efforts(graph, 10)
        plant.resume()
    _, stderr = process.communicate(timeout=60)
    assert process.returncode == 0, stderr
    stamps = read_run(bag).topics["command"].stamps
    assert np.count_nonzero((stamps - stamps[0]) % 1_000_000) >= 10
    assert (np.diff(stamps) > 0).all()
    found = fpt_json("rerun", bag)
    assert found["equal"] is True
    assert found["parts"]["plant_simulator"]["cycles"] == 1500


def wait_for_safe_efforts(graph, count):
    """Until so many commands have come that answer no measurement."""
    found = []

    def on_command(message):
        if all(math.isnan(r) for r in message.points[0].accelerations):
            found.append(message)

    subscription = graph.node.create_subscription(
        JointTrajectory, "/command", on_command, loop_qos(10)
    )
    while len(found) < count:
        graph.executor.spin_once()
    graph.node.destroy_subscription(subscription)
