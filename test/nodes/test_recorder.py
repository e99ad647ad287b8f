"""The recorder's process: killed, without a disk, among nodes started by hand."""

import json
import os
import random
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest
import samples
from command import forked_fpt as fpt
from command import forked_fpt_json as fpt_json
from command import node_of, start_fpt
from test_endings import ended, under_way
from watcher import watcher

from fpt_ros.bags.reader import info, read_run
from fpt_ros.bags.recover import recover
from fpt_ros.experiments.experiment import load
from fpt_ros.replay.recorded import Recorded
from fpt_ros.replay.rerun import rerun

BIN = Path(sys.executable).parent


@pytest.mark.parametrize("moment", samples.sample(range(20), 2))
def test_killed_recorder_loses_no_acknowledged_cycle(tmp_path, moment):
    """At random moments, some before the first chunk is full."""
    at = random.Random(moment).uniform(0.02, 1.0)
    process, _ = under_way(tmp_path, "--restarts", 0)
    with watcher() as graph, graph.acknowledgements() as acknowledged:
        graph.wait_for_stamp(0.2 + at)
        node_of(process, "recorder").kill()
    ended(process)
    run = read_run(recover(tmp_path / "bag", tmp_path / "recovered").directory)
    counts = {name: len(series.stamps) for name, series in run.topics.items()}
    assert max(counts.values()) - min(counts.values()) <= 1
    # the plant is at most as far ahead of what was acknowledged as publishers keep
    assert min(counts.values()) >= round(1000 * (0.2 + at)) - 64
    assert acknowledged
    assert min(counts.values()) > round(1000 * max(acknowledged))
    for series in run.topics.values():
        assert series.stamps.tolist() == [k * 1_000_000 for k in range(len(series.stamps))]
    again = Recorded(tmp_path / "recovered")
    assert all(found.equal for found in rerun(again).values())


@pytest.mark.parametrize("how", ["removed", "full"])
def test_a_recording_that_ends_does_not_end_the_run(tmp_path, how):
    bag = tmp_path / "bag"
    process = start_fpt("run", "tora", "--duration", 8, "--record", bag, "--json")
    with watcher() as graph:
        graph.wait_for_stamp(0.05)
        recorder = node_of(process, "recorder")
        if how == "removed":
            shutil.rmtree(bag)
        else:
            import resource

            size = sum(path.stat().st_size for path in bag.iterdir())
            resource.prlimit(recorder.pid, resource.RLIMIT_FSIZE, (size + 1000, size + 1000))
    stdout, stderr = process.communicate(timeout=120)
    assert process.returncode == 1, stderr
    said = stderr.splitlines()[-1]
    assert "recorder: the recording ends after" in said
    assert "the run went on" in said
    result = json.loads(stdout)
    assert result["complete"] is False
    if how == "full":
        assert 0 < result["cycles"] < 8_000
        assert info(bag)["complete"] is False
        # all that was recorded before is there
        assert result["cycles"] - len(read_run(bag).topics["command"].stamps) in (0, 1)
    else:
        assert "has been removed" in result["reason"]


def test_nodes_started_by_hand_have_their_own_parameters(tmp_path):
    """One with -p, against what the parameter file says."""
    experiment = load("tora", duration=0.1).for_graph(False)
    experiment = experiment.with_values("plant_simulator", await_recorder=True)
    experiment = experiment.with_values("recorder", directory=str(tmp_path / "bag"), cycles=100)
    experiment.write(tmp_path / "tora.yaml")
    names = ["recorder", "denoiser", "trajectory_generator", "fpt_deformer", "plant_simulator"]
    given = ["--ros-args", "--params-file", str(tmp_path / "tora.yaml")]
    own = {"fpt_deformer": ["-p", "K:=0.45"]}
    processes = [
        subprocess.Popen([BIN / name, *given, *own.get(name, [])], stderr=subprocess.PIPE)
        for name in names
    ]
    try:
        assert processes[-1].wait(timeout=60) == 0
    finally:
        for process in reversed(processes):
            process.send_signal(signal.SIGTERM)
            process.communicate(timeout=60)
    run = read_run(tmp_path / "bag")
    assert run.info["complete"] == "true"
    assert run.parameters["fpt_deformer"]["K"] == 0.45
    assert run.parameters["fpt_deformer"]["A"] == -0.1
    assert run.parameters["plant_simulator"]["exact.m"] == 20.0


def test_split_and_all_topics(tmp_path):
    result = fpt_json(
        "run", "tora", "--duration", 0.4, "--record", tmp_path / "b", "--split", "0.1s"
    )
    assert result["complete"] is True
    about = info(tmp_path / "b")
    assert len(about["files"]) >= 4
    assert {"/rosout", "/diagnostics", "/parameter_events", "/parameter_changes"} <= set(
        about["topics"]
    )
    assert about["topics"]["/command"]["messages"] == 400
    assert fpt("run", "tora", "--split", "3 apples").returncode == 2
    assert os.listdir(tmp_path) == ["b"]
