"""Pause, steps, stop and emergency stop of a running graph."""

import signal

import numpy as np
from command import forked_fpt, forked_fpt_json, start_fpt
from std_msgs.msg import Bool
from watcher import watcher

from fpt_ros.bags.reader import read_run


def ask(*words):
    done = forked_fpt(*words)
    assert done.returncode == 0, done.stderr
    return done.stdout


def efforts(bag):
    return read_run(bag).topics["command"].vectors["effort"]


def test_a_run_that_was_paused_and_stepped_has_the_numbers_of_one_that_was_not(tmp_path):
    process = start_fpt("run", "tora", "--duration", 1000, "--record", tmp_path / "bag")
    with watcher() as graph:
        graph.wait_for_stamp(0.1)
        ask("pause")
        first = graph.stands_still()
        ask("step", 7)
        assert graph.stands_still() == first + 7_000_000
        ask("resume")
        graph.wait_for_next()
    assert "ends" in ask("stop")
    _, stderr = process.communicate(timeout=60)
    assert process.returncode == 0, stderr
    found = efforts(tmp_path / "bag")
    engine = tmp_path / "engine"
    forked_fpt_json("simulate", "tora", "--duration", len(found) / 1000, "--record", engine)
    assert np.array_equal(found, efforts(engine))


def test_emergency_stop_by_service_and_topic_and_its_release(tmp_path):
    """An oscillator that bears the safe effort for as long as the test takes."""
    process = start_fpt(
        "run", "vdp_second_order", "--duration", 1000, "--record", tmp_path / "bag",
        "--set", "fpt_deformer.safe_effort=[1.5]",
    )  # fmt: skip
    with watcher() as graph:
        graph.wait_for_stamp(0.1)
        assert "safe effort" in ask("e-stop")
        graph.wait_for_next()
        assert "anew" in ask("e-stop", "--release")
        graph.wait_for_next()
        button = graph.node.create_publisher(Bool, "/e_stop", 10)
        while not graph.get_parameter("fpt_deformer", "stopped"):
            button.publish(Bool(data=True))
        graph.wait_for_next()
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)
    is_safe = (efforts(tmp_path / "bag") == [1.5]).all(axis=1)
    changes = np.flatnonzero(np.diff(is_safe.astype(int)))
    assert not is_safe[0]
    assert is_safe[-1]
    assert len(changes) == 3  # stopped, released, stopped
