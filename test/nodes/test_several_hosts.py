"""A graph over two hosts, between which the cable is pulled out and put in again."""

import json
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path
from threading import Event
from time import time_ns

import numpy as np
import pytest
import samples
from command import end_started, forked_fpt, forked_fpt_json, start_fpt
from sensor_msgs.msg import JointState
from two_hosts import ENVIRONMENT, two_hosts
from watcher import PATIENCE, watcher

from fpt_ros.bags.reader import read_run

EXAMPLE = Path(__file__).parents[2] / "examples" / "foreign_robot"
CUT = 5.0
HERE = "plant_simulator"
THERE = "denoiser,trajectory_generator,fpt_deformer"
SAFE = 0.1
"""The plant's command_timeout [s]."""


@pytest.fixture
def hosts(monkeypatch):
    for name, value in ENVIRONMENT.items():
        monkeypatch.setenv(name, value)
    with two_hosts() as pair:
        yield pair


def apart(test, *arguments):
    """In a process of its own: Fast DDS keeps the interfaces that its first node has seen."""
    with ProcessPoolExecutor(1, get_context("spawn")) as process:
        process.submit(_tidy, test, *arguments).result()


def _tidy(test, *arguments):
    try:
        test(*arguments)
    finally:
        end_started()


def start_both(hosts, bag, *options):
    """The plant and the recorder on one host, the controller on the other."""
    with hosts.on(1):
        controller = start_fpt("run", *options, "--only", THERE, "--json")
    with hosts.on(0):
        plant = start_fpt("run", *options, "--only", HERE, "--record", bag, "--json")
    return plant, controller


def wait_until_it_repeats_itself(graph):
    """Until the plant has said the same twice, because no command comes."""
    stamps = []
    subscription = graph.node.create_subscription(
        JointState,
        "/joint_states",
        lambda m: stamps.append((m.header.stamp.sec, m.header.stamp.nanosec)),
        10,
    )
    while len(stamps) < 2 or stamps[-1] != stamps[-2]:
        graph.executor.spin_once(timeout_sec=PATIENCE)
    graph.node.destroy_subscription(subscription)


def ended(process):
    stdout, stderr = process.communicate(timeout=100)
    assert process.returncode == 0, stderr
    return json.loads(stdout)


def test_lockstep_over_a_cable_that_is_cut_has_the_numbers_of_the_engine(hosts, tmp_path):
    if not samples.whole:
        pytest.skip("half a minute: with --all")
    apart(lockstep, hosts, tmp_path)


def lockstep(hosts, tmp_path):
    cycles = 6000
    options = ("tora", "--duration", cycles / 1000)
    plant, controller = start_both(hosts, tmp_path / "bag", *options)
    with hosts.on(0), watcher() as graph:
        graph.wait_for_stamp(0.05)
        hosts.cut()
        wait_until_it_repeats_itself(graph)
        Event().wait(CUT)
        hosts.mend()
    assert ended(plant)["complete"] is True
    assert ended(controller)["cycles"] == cycles
    forked_fpt_json("simulate", *options, "--record", tmp_path / "engine")
    found, truth = (read_run(tmp_path / name).topics for name in ("bag", "engine"))
    for topic in ("joint_states", "state_estimate", "desired", "command"):
        for name, values in truth[topic].vectors.items():
            assert np.array_equal(found[topic].vectors[name], values, equal_nan=True)


def test_real_time_over_a_cable_that_is_cut_is_safe_and_comes_back(hosts, tmp_path, monkeypatch):
    if not samples.whole:
        pytest.skip("half a minute: with --all")
    monkeypatch.chdir(EXAMPLE)
    apart(real_time, hosts, tmp_path)


def real_time(hosts, tmp_path):
    options = ("arm.yaml", "--realtime", "--duration", 14, "--set", "plant_simulator.dt=0.005")
    plant, controller = start_both(hosts, tmp_path / "bag", *options)
    with hosts.on(0), watcher() as graph:
        graph.wait_for_next()
        graph.stamp_after(2.5)
        hosts.cut()
        cut = time_ns()
        Event().wait(CUT)
        hosts.mend()
    result = ended(plant)
    ended(controller)
    assert result["complete"] is True  # not diverged
    topics = read_run(tmp_path / "bag").topics
    measured, desired = topics["joint_states"], topics["desired"]
    since = (measured.stamps - cut) * 1e-9
    acting = np.any(measured.vectors["effort"] != 0.0, axis=1)
    assert acting[(since < 0.0) & (since > -0.5)].any()
    assert not acting[(since > SAFE + 0.015) & (since < CUT / 2)].any()
    assert acting[since > since[-1] - 1.0].any()
    common, mine, theirs = np.intersect1d(desired.stamps, measured.stamps, return_indices=True)
    last = common > common[-1] - 2 * 10**9
    for joint in ("shoulder", "elbow"):
        motion = measured.column("position", joint)[theirs]
        error = desired.column("positions", joint)[mine] - motion
        assert np.sqrt(np.mean(error[last] ** 2)) < 0.5


def test_what_only_takes():
    done = forked_fpt("run", "tora", "--only", "plant_simulator,brain")
    assert done.returncode == 2
    assert "there is no node 'brain', only plant_simulator, denoiser" in done.stderr
    done = forked_fpt("run", "tora", "--only", "recorder")
    assert done.returncode == 2
    assert "takes --record DIR" in done.stderr
    done = forked_fpt("run", "tora", "--only", "denoiser", "--composed")
    assert done.returncode == 2
