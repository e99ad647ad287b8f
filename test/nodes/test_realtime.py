"""The graph on the wall clock."""

import numpy as np
from command import OSCILLATOR, forked_fpt, node_of, start_fpt
from command import forked_fpt_json as fpt_json
from mcap_ros2.reader import read_ros2_messages
from sensor_msgs.msg import JointState
from watcher import watcher

from fpt_ros.bags.reader import info, read_run
from fpt_ros.cycle.stages import STAGES
from fpt_ros.nodes.qos import loop_qos


def test_cycles_follow_the_wall_clock(tmp_path):
    bag = tmp_path / "bag"
    result = fpt_json(
        "run", *OSCILLATOR, "--realtime", "--duration", 3, "--record", bag,
        "--set", "plant_simulator.dt=0.005",
    )  # fmt: skip
    assert result["complete"] is True, result["reason"]
    assert result["wall_time"] >= 2.9
    run = read_run(bag)
    stamps = run.topics["joint_states"].stamps
    assert len(stamps) == 600
    assert set(stamps[1:] - stamps[:-1]) == {5_000_000}
    assert stamps[0] > 1_700_000_000 * 10**9
    # what the nodes said before the first cycle is of that time too, and not of 1970
    assert 2.9 < float(str(info(bag)["duration"])) < 300.0
    reports = [
        {entry.key: entry.value for entry in message.ros_msg.status[0].values}
        for message in read_ros2_messages(bag / "bag_0.mcap", topics=["/diagnostics"])
        if message.ros_msg.status[0].name == "plant_simulator"
    ]
    assert any("deadline misses" in report for report in reports)
    assert any("latency p99 [ms]" in report for report in reports)
    told = run.latency
    assert told is not None
    assert told.cycles == 600  # the last report comes with the last cycle
    assert told.total + told.missed >= 599  # all but the first came in time, late or never
    assert told.total <= 599
    largest = max(float(r["latency max [ms]"]) for r in reports if "latency max [ms]" in r)
    assert told.largest == largest / 1e3  # as it is read; 1e3 * (x / 1e3) is not always x
    assert result["real_time"]["missed_deadlines"] == told.missed
    is_told_what_its_processes_took(bag)


def is_told_what_its_processes_took(bag):
    """By `fpt info`, and on the page of the report and beside it."""
    costs = fpt_json("info", bag)["costs"]
    assert {name for cost in costs for name in cost["nodes"]} == {*STAGES, "recorder"}
    assert len(costs) == 6
    for cost in costs:
        assert 0.0 <= cost["processor_mean_percent"] <= cost["processor_max_percent"] < 200.0
        assert 20.0 < cost["memory_start_mb"] <= cost["memory_end_mb"] + 10.0
    assert "growth" in forked_fpt("info", bag).stdout
    report = bag.with_name("report")
    assert fpt_json("report", bag, "--out", report)["costs"] == costs
    page = (report / "index.html").read_text()
    assert '<th scope="row">trajectory_generator</th>' in page


HOLD = ("when_stopped=hold", "hold.stiffness=[40.0]", "hold.damping=[6.0]", "safe_effort=[0.5]")


def test_a_loop_that_is_silent_or_stopped_holds_the_position(tmp_path):
    """Another node stands still: the deformer holds by the measurement alone, and comes back.

    Where it stands still itself nobody holds: after its own command_timeout the plant applies its
    own safe effort.
    """
    settings = [word for each in HOLD for word in ("--set", f"fpt_deformer.{each}")]
    process = start_fpt(
        "run", *OSCILLATOR, "--realtime", "--duration", 1000,
        "--record", tmp_path / "bag", "--set", "plant_simulator.dt=0.005",
        "--set", "plant_simulator.safe_effort=0.25", *settings,
    )  # fmt: skip
    with watcher() as graph:
        graph.wait_for_next()
        other = node_of(process, "trajectory_generator")
        other.suspend()
        graph.stamp_after(1.0)
        silent = graph.stamp_after(1.0)
        other.resume()
        graph.stamp_after(0.5)
        assert "the position is held" in forked_fpt("e-stop").stdout
        graph.stamp_after(1.0)
        stopped = graph.stamp_after(0.5)
        node_of(process, "fpt_deformer").suspend()
        unheard = states_without_commands(graph)
        node_of(process, "fpt_deformer").resume()
        graph.stamp_after(0.5)
        forked_fpt("stop")
    _, stderr = process.communicate(timeout=90)
    assert "diverged" not in stderr
    topics = read_run(tmp_path / "bag").topics
    for stamp, source, (q, v) in (
        (silent, topics["joint_states"], ("position", "velocity")),
        (stopped, topics["state_estimate"], ("positions", "velocities")),
    ):
        held, efforts = positions_held(
            topics["command"], source.stamps, source.column(q, "q1"), source.column(v, "q1"), stamp
        )
        assert len(efforts) > 5
        assert np.ptp(held) < 1e-9, held
    assert topics["desired"].stamps[-1] > silent  # it came back
    acted, stamps = topics["joint_states"].column("effort", "q1"), topics["joint_states"].stamps
    assert acted[stamps == unheard] == 0.25
    assert (acted[stamps > unheard] != 0.25).any()  # it holds again
    assert (np.diff(topics["command"].stamps) > 0).all()  # no cycle is answered twice
    assert fpt_json("rerun", tmp_path / "bag")["equal"] is True


def states_without_commands(graph):
    """Stamp [ns] of the 100th measurement from now on: with none of the deformer's answers."""
    stamps = []
    subscription = graph.node.create_subscription(
        JointState,
        "/joint_states",
        lambda m: stamps.append(m.header.stamp.sec * 10**9 + m.header.stamp.nanosec),
        loop_qos(1),
    )
    while len(stamps) < 100:
        graph.executor.spin_once()
    graph.node.destroy_subscription(subscription)
    return stamps[-1]


def positions_held(command, stamps, q, v, until):
    """What the efforts of the last 0.3 s before a stamp say of the position that is held."""
    common, ours, theirs = np.intersect1d(command.stamps, stamps, return_indices=True)
    there = (common <= until) & (common > until - 300_000_000)
    effort = command.column("effort", "q1")[ours][there]
    return (effort - 0.5 + 6.0 * v[theirs][there]) / 40.0 + q[theirs][there], effort


def test_late_commands_give_way_to_the_safe_effort():
    from fpt_ros.experiments.experiment import load

    plant = load("tora", settings=["plant_simulator.safe_effort=0.5"]).loop().plant
    command = plant.safe_command(0)
    assert command.effort == [0.5, 0.5, 0.5]
    plant.advance(command, 0)
    assert list(plant.measure(1_000_000, 1).effort) == [0.5, 0.5, 0.5]


def test_a_recorder_that_stands_still_does_no_harm_and_is_told_of(tmp_path):
    """Frozen for two seconds: the loop goes on; what the recording lacks is said, or nothing is."""
    bag = tmp_path / "bag"
    process = start_fpt(
        "run", *OSCILLATOR, "--realtime", "--duration", 10, "--record", bag,
        "--set", "plant_simulator.dt=0.005",
    )  # fmt: skip
    with watcher() as graph:
        graph.wait_for_next()
        recorder = node_of(process, "recorder")
        recorder.suspend()
        stamp = graph.stamp_after(2.0)
        recorder.resume()
    _, stderr = process.communicate(timeout=90)
    run = read_run(bag)
    stamps = run.topics["joint_states"].stamps
    assert "diverged" not in stderr
    assert stamps[-1] - stamps[0] == 1999 * 5_000_000
    assert stamp <= stamps[-1]
    if len(stamps) == 2000:
        assert process.returncode == 0, stderr
    else:
        assert process.returncode == 1
        assert f"lacks {2000 - len(stamps)} of 2000 cycles" in stderr
        assert run.info["complete"] == "false"
