"""Recorded inputs over DDS into a node that runs: its answers are the recorded ones."""

import subprocess
import sys
from contextlib import contextmanager
from pathlib import Path

import pytest
from command import BIN, fpt, fpt_json

sys.path.append(str(Path(__file__).parents[1] / "replay"))

from recorded_changes import INFO, recorded

CYCLES = 120
CHANGES = {
    40: {"fpt_deformer": {"A": -0.2}},
    60: {"plant_simulator": {"exact.m": 21.0}},
}


@contextmanager
def running(name, bag, *options):
    """The node as a process, with the parameters of the recording."""
    file = bag.with_name("parameters.yaml")
    file.write_text(fpt("info", bag, "--parameters").stdout)
    command = [BIN / name, "--ros-args", "--params-file", file, *options]
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        yield
    finally:
        process.terminate()
        process.communicate(timeout=60)


@pytest.mark.parametrize("node", ["fpt_deformer", "plant_simulator"])
def test_in_lockstep_with_a_change_in_flight(tmp_path, node):
    bag = recorded(tmp_path / "bag", "tora", CYCLES, CHANGES)
    with running(node, bag):
        found = fpt_json("replay", bag, "--node", node, "--live", "--record", tmp_path / "out")
    assert (found["equal"], found["cycles"]) == (True, CYCLES)
    assert fpt("diff", bag, tmp_path / "out").stdout == "equal to the last bit\n"


def test_by_the_clock_into_a_node_with_another_gain(tmp_path):
    """In real time, where a node answers the newest cycle: one that it passes over differs too."""
    info = {**INFO, "clock": "realtime", "namespace": "/"}
    bag = recorded(tmp_path / "bag", "tora", CYCLES, info=info)
    with running("fpt_deformer", bag, "-p", "realtime:=true", "-p", "A:=-0.4"):
        done = fpt("replay", bag, "--node", "fpt_deformer", "--live", "--rate", "0.5")
    assert done.returncode == 1
    assert f"of {CYCLES} cycles differ" in done.stdout
    assert "/command differs first in cycle " in done.stdout


def test_there_is_no_such_node(tmp_path, monkeypatch):
    from fpt_ros.errors import BadInput, RunFailed
    from fpt_ros.nodes import replay
    from fpt_ros.replay.recorded import Recorded
    from fpt_ros.replay.replayed import Replay

    bag = recorded(tmp_path / "bag", "tora", 5)
    monkeypatch.setattr(replay, "PATIENCE", 0.5)
    deformer = Replay(Recorded(bag), "fpt_deformer")
    with pytest.raises(RunFailed, match="there is no node fpt_deformer that listens: start it fir"):
        replay.run_live(deformer, None, lambda done: None)
    with pytest.raises(BadInput, match="--rate 0: it takes a positive number"):
        replay.run_live(deformer, 0.0, lambda done: None)
    with pytest.raises(BadInput, match="a running plant_simulator has a clock of its own"):
        replay.run_live(Replay(Recorded(bag), "plant_simulator"), 1.0, lambda done: None)
