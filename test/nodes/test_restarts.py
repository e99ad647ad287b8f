"""kill -9 of nodes of a real graph: started again, they go on, and the numbers are the same."""

import json
import signal
from contextlib import ExitStack, suppress
from pathlib import Path
from time import sleep

import numpy as np
import psutil
import pytest
import samples
from command import node_if_any, node_of, start_fpt
from std_srvs.srv import Trigger
from stranger import kinds, stranger
from test_strangers import HEARD
from watcher import watcher

from fpt_ros.bags.reader import info, read_run
from fpt_ros.engine.engine import Engine
from fpt_ros.experiments.experiment import load
from fpt_ros.nodes.shared_memory import RUN_FOLDER
from fpt_ros.replay.recorded import Recorded
from fpt_ros.replay.rerun import rerun

ALL = ["plant_simulator", "denoiser", "trajectory_generator", "parameter_tuner", "fpt_deformer"]
PATIENCE = 300
TOPICS = ("joint_states", "state_estimate", "desired", "tuning", "command")


def killed(process, name, graph):
    """Kill a node while the loop runs, and wait until it runs again."""
    graph.wait_for_next()
    node_of(process, name).kill()
    graph.wait_for_next()


def outcome(process):
    stdout, stderr = process.communicate(timeout=PATIENCE)
    assert process.returncode == 0, stderr
    return json.loads(stdout), stderr


def has_the_numbers_of_one_in_process(bag):
    assert info(bag)["missing"] == []
    (found,) = rerun(Recorded(bag)).values()
    assert found.equal
    return read_run(bag)


def is_undisturbed(bag, result):
    """Complete, every cycle there, and all equal to a run in process, to the last bit."""
    assert info(bag)["complete"] is True
    run = has_the_numbers_of_one_in_process(bag)
    for name in TOPICS:
        if name in run.topics:
            assert len(run.topics[name].stamps) == result["cycles"]
    return run


def folders_of(process):
    used, prefix = set(), RUN_FOLDER.format(process.pid)
    for child in psutil.Process(process.pid).children(recursive=True):
        maps = Path(f"/proc/{child.pid}/maps").read_text()
        used |= {Path(line[line.index("/") :]) for line in maps.splitlines() if prefix in line}
    return {path.parent for path in used}


def test_a_node_and_the_recorder_at_once(tmp_path):
    """A change of parameters in flight before it is in force afterwards.

    A stranger, whose latched messages come to who is started again, is none of the run's own.
    """
    process = start_fpt("run", "tora", "--duration", 2, "--record", tmp_path / "bag", "--json")
    with watcher() as graph, ExitStack() as later:
        assert graph.call(Trigger, "/plant_simulator/pause", Trigger.Request()).success
        graph.wait_for_stamp(0.0)
        somebody = later.enter_context(stranger(HEARD))
        (folder,) = folders_of(process)
        assert graph.set_parameter("fpt_deformer", "A", -0.2) == (True, "")
        somebody.match(HEARD)
        for topic in HEARD:
            for data in kinds(topic, 10**9).values():
                somebody.say(topic, data)
        assert graph.call(Trigger, "/plant_simulator/resume", Trigger.Request()).success
        for name in ("fpt_deformer", "recorder"):
            node_of(process, name).kill()
        with watcher() as another:  # who was there before may go on asking the killed one
            another.wait_for_next()
            assert another.get_parameter("fpt_deformer", "A") == -0.2
    result, stderr = outcome(process)
    assert result["restarts"] == 2
    assert "the node fpt_deformer was killed by SIGKILL: started again" in stderr
    run = is_undisturbed(tmp_path / "bag", result)
    assert result["cycles"] == 2000
    (change,) = run.changes
    assert (change.node, change.values) == ("fpt_deformer", {"A": -0.2})
    assert not folder.exists()
    assert len(list((tmp_path / "bag").iterdir())) == 2


WHOLE = [
    ("tora_auto", 20, ()),  # with a tuner in the loop
    ("tora", 60, ("--composed",)),  # three times as fast
    ("panda", 20, ()),
]


@pytest.mark.parametrize(("name", "seconds", "options"), samples.sample(WHOLE, 0))
def test_each_node_one_after_the_other_in_one_run(tmp_path, name, seconds, options):
    process = start_fpt(
        "run", name, "--duration", seconds, "--record", tmp_path / "bag", "--json", *options
    )
    nodes = ["composed", "recorder"] if options else [*ALL, "recorder"]
    with watcher() as graph:
        for node in nodes:
            killed(process, node, graph)
    result, _ = outcome(process)
    assert result["restarts"] == len(nodes)
    run = is_undisturbed(tmp_path / "bag", result)
    engine = Engine(load(name, duration=seconds).loop())
    engine.run()
    for topic, truth in engine.topics().items():
        for field, vector in truth.vectors.items():
            assert vector.tobytes() == run.topics[topic].vectors[field].tobytes()


def test_a_recorder_that_is_killed_when_the_plant_has_gone(tmp_path):
    """All is recorded, but the file is not closed: the next one does it, though asked to end."""
    process = start_fpt("run", "tora", "--duration", 4, "--record", tmp_path / "bag", "--json")
    while (plant := node_if_any(process, "plant_simulator")) is None:
        assert process.poll() is None
        sleep(0.01)
    plant.wait(timeout=PATIENCE)
    with suppress(AssertionError, psutil.NoSuchProcess):  # it may have ended by itself
        node_of(process, "recorder").kill()
    result, _ = outcome(process)
    is_undisturbed(tmp_path / "bag", result)


def test_a_plant_that_is_killed_in_a_pause_or_an_emergency_stop_is_still_in_it(tmp_path):
    """An oscillator that bears the safe effort; who was there before may go on asking the dead."""
    bag = tmp_path / "bag"
    process = start_fpt("run", "vdp_second_order", "--duration", 1000, "--record", bag)

    def ask(graph, service):
        assert graph.call(Trigger, f"/{service}", Trigger.Request()).success

    with watcher() as graph:
        graph.wait_for_stamp(0.1)
        ask(graph, "plant_simulator/pause")
        stood = graph.stands_still()
        node_of(process, "plant_simulator").kill()
    with watcher() as graph:
        ask(graph, "plant_simulator/step")
        graph.wait_for_stamp((stood + 1_000_000) / 1e9 - 1e-6)  # its nodes may still be found
        assert graph.stands_still() == stood + 1_000_000
        ask(graph, "fpt_deformer/e_stop")
        ask(graph, "plant_simulator/resume")
        killed(process, "plant_simulator", graph)
        assert graph.get_parameter("fpt_deformer", "stopped")
    with watcher() as graph:
        ask(graph, "plant_simulator/pause")
        stopped = graph.stands_still()
        ask(graph, "fpt_deformer/release")
        ask(graph, "plant_simulator/step")
        graph.stands_still()
        ask(graph, "plant_simulator/stop")
    _, stderr = process.communicate(timeout=PATIENCE)
    assert process.returncode == 0, stderr
    assert stderr.count("SIGKILL: started again") == 2
    run = has_the_numbers_of_one_in_process(bag)
    (change, release) = run.changes
    assert (change.values, release.values) == ({"stopped": True}, {"stopped": False})
    assert stood < change.stamp < stopped <= release.stamp
    command = run.topics["command"]
    inside = (command.stamps >= change.stamp) & (command.stamps < release.stamp)
    assert (command.vectors["effort"][inside] == 0.0).all()


@pytest.mark.parametrize("most", samples.sample([1, 2], 0))
def test_a_node_that_is_killed_too_often_ends_the_run(tmp_path, most):
    process = start_fpt(
        "run", "tora", "--duration", 1000, "--record", tmp_path / "bag", "--restarts", most
    )
    with watcher() as graph:
        for _ in range(most):
            killed(process, "denoiser", graph)
        graph.wait_for_next()
    node_of(process, "denoiser").kill()
    _, stderr = process.communicate(timeout=PATIENCE)
    assert process.returncode == 1
    assert stderr.count("SIGKILL: started again") == most
    assert "fpt: the node denoiser was killed by SIGKILL; its last lines:" in stderr
    assert info(tmp_path / "bag")["complete"] is False


@pytest.mark.parametrize("node", samples.sample(["plant_simulator", "denoiser", "fpt_deformer"], 0))
def test_in_real_time_it_comes_back(tmp_path, node):
    """The oscillator bears the safe effort meanwhile."""
    process = start_fpt(
        "run", "vdp_second_order", "--realtime", "--duration", 1000, "--record", tmp_path / "bag",
        "--set", "plant_simulator.dt=0.01",
    )  # fmt: skip
    with watcher() as graph:
        graph.wait_for_stamp(0.0)
        before = graph.stamp_after(0.5)
        node_of(process, node).kill()
        while graph.stamp_after(0.5) < before + 5 * 10**9:
            pass
    process.send_signal(signal.SIGINT)
    _, stderr = process.communicate(timeout=PATIENCE)
    assert process.returncode == 130, stderr
    run = read_run(tmp_path / "bag")
    command, states = run.topics["command"], run.topics["joint_states"]
    assert set(np.diff(states.stamps)) == {10_000_000}
    learnt = ~np.isnan(command.vectors["accelerations"][:, 0])
    assert learnt[-50:].any()  # it controls again, and not the safe effort
