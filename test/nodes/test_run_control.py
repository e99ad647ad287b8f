"""Pause, steps, stop and emergency stop of a running graph."""

import signal

import numpy as np
from command import forked_fpt, forked_fpt_json, node_of, start_fpt
from std_msgs.msg import Bool
from watcher import watcher

from fpt_ros.bags.reader import read_run
from fpt_ros.engine.engine import Engine
from fpt_ros.experiments.experiment import load


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


EVERYTHING = (
    "plant_simulator.noise.position=1e-5",
    "plant_simulator.measured=position",
    "plant_simulator.actuators.kinds=[dropouts]",
    "denoiser.method=kalman_bank",
    "denoiser.sigma=1e-3",
    "denoiser.synchronised=true",
    "fpt_deformer.synchronised=true",
    "parameter_tuner.precursor=true",
)
"""What remembers: noise, chance in an actuator, a filter that is shown commands, a tuner."""


def test_a_run_that_is_reset_has_the_numbers_of_a_new_one(tmp_path):
    """Running, paused, and in an emergency stop; parameters stay as they are, stamps go on."""
    bag, words = tmp_path / "bag", [word for text in EVERYTHING for word in ("--set", text)]
    process = start_fpt("run", "vdp_second_order", "--duration", 1000, "--record", bag, *words)
    with watcher() as graph:
        graph.wait_for_stamp(0.1)
        assert "begins again after this cycle" in ask("reset")
        graph.wait_for_next()
        ask("pause")
        stood = graph.stands_still()
        ask("params", "set", "fpt_deformer", "A=0.5e-5")
        assert "stands still there" in ask("reset")
        assert graph.stands_still() == stood
        ask("resume")
        graph.wait_for_next()
        ask("e-stop")
        graph.wait_for_next()
        ask("reset")
        graph.wait_for_next()
        for name in ("plant_simulator", "denoiser"):  # a node that is started again knows of it
            node_of(process, name).kill()
            graph.wait_for_next()
    assert "ends" in ask("stop")
    _, stderr = process.communicate(timeout=60)
    assert process.returncode == 0, stderr
    run = read_run(bag)
    stamps = run.topics["command"].stamps
    assert set(np.diff(stamps)) == {1_000_000}
    begun = [round(float(each.split()[0]) * 1000) for each in run.info["begun_again"].split(", ")]
    assert len(begun) == 3
    assert begun[1] == stood // 1_000_000 + 1
    for first, end, own in (
        (0, begun[0], ()),
        (begun[0], begun[1], ()),
        (begun[1], begun[1] + 100, ("fpt_deformer.A=0.5e-5",)),
        (begun[2], len(stamps), ("fpt_deformer.A=0.5e-5", "fpt_deformer.stopped=true")),
    ):
        fresh = Engine(
            load("vdp_second_order", settings=(*EVERYTHING, *own), duration=(end - first) / 1000)
            .loop()
        )  # fmt: skip
        fresh.run()
        for topic, truth in fresh.topics().items():
            for field, numbers in truth.vectors.items():
                found = run.topics[topic].vectors[field][first:end]
                assert np.array_equal(found, numbers, equal_nan=True), (first, topic, field)
    done = forked_fpt("rerun", bag)
    assert done.returncode == 2
    assert "the run was reset at" in done.stderr


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
