"""The flat view of trajectories: the same numbers, by the names of the joints."""

from pathlib import Path

import numpy as np
import pytest
from command import forked_fpt, forked_fpt_json
from recorded_run import Recorded

from fpt_ros import load
from fpt_ros.bags.flat import write_flat
from fpt_ros.bags.reader import read_run
from fpt_ros.bags.writer import BagWriter
from fpt_ros.messages.topics import JOINT_TRAJECTORY


def test_the_numbers_are_those_of_the_trajectories(recorded: Recorded, tmp_path: Path) -> None:
    file = tmp_path / "flat.mcap"
    counts, said = write_flat(recorded.directory, file)
    assert said == ()
    tables = load(file)
    assert set(counts) == set(tables)
    for topic, names in (("/desired", ("q2", "q3")), ("/state_estimate", ("q1", "q2", "q3"))):
        flat, response = tables[f"{topic}/flat"], tables[f"{topic}/flat/accelerations"]
        for name in names:
            for ours, theirs in (("position", "positions"), ("velocity", "velocities")):
                column = tables[topic][f"{theirs}.{name}"]
                assert np.array_equal(flat[f"{ours}.{name}"], column, equal_nan=True)
            column = tables[topic][f"accelerations.{name}"]
            assert np.array_equal(response[f"position.{name}"], column, equal_nan=True)
    command = tables["/command/flat"]
    assert list(command.filter(like="effort")) == ["effort.q1", "effort.q2", "effort.q3"]
    assert not list(command.filter(like="position"))
    run = read_run(file)
    assert run.info["complete"] == "true"
    assert run.parameters == recorded.parameters
    for name, series in recorded.topics.items():
        for vector, matrix in series.vectors.items():
            assert np.array_equal(run.topics[name].vectors[vector], matrix, equal_nan=True)


def test_again_is_the_same_and_what_has_no_flat_view_is_told(
    recorded: Recorded, tmp_path: Path
) -> None:
    first, _ = write_flat(recorded.directory, tmp_path / "a.mcap")
    assert write_flat(tmp_path / "a.mcap", tmp_path / "b.mcap") == (first, ())
    with BagWriter(tmp_path / "bag", {}, {}) as bag:
        for stamp, points in ((0, 0), (5, 2)):
            joint_names = b"\0" * 8 + b"\1\0\0\0\0\0\0\0" + b"\0" * 4
            bag.write("/plan", JOINT_TRAJECTORY, stamp, b"\0\1\0\0" + joint_names + bytes([points]))
    counts, said = write_flat(tmp_path / "bag", tmp_path / "c.mcap")
    assert counts == {"/plan": 2}
    assert said == (
        "2 messages on /plan have another number of points than one: they have no flat view",
    )


def test_the_command(recorded: Recorded, tmp_path: Path) -> None:
    out = tmp_path / "x.mcap"
    done = forked_fpt_json("export", recorded.directory, "--format", "mcap", "--out", out)
    assert done["topics"]["/command/flat"] == 1000
    words = ("export", recorded.directory, "--format", "mcap")
    bad = forked_fpt(*words, "--topic", "/no", "--out", out)
    assert bad.returncode == 2
    assert "has no topic '/no': there are /command, /desired" in bad.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["x.mcap"]
    bad = forked_fpt("layout", out, "--for", "excel")
    assert bad.returncode == 2
    assert bad.stderr == "fpt: --for excel: programs are foxglove, plotjuggler\n"


@pytest.mark.parametrize("out", ["no/x.mcap", "."])
def test_where_it_cannot_be_written(recorded: Recorded, tmp_path: Path, out: str) -> None:
    words = ("export", recorded.directory, "--format", "mcap", "--out", tmp_path / out)
    done = forked_fpt(*words)
    assert done.returncode == 2
    assert len(done.stderr.splitlines()) == 1
    assert list(tmp_path.iterdir()) == []
