"""``fpt info``, ``recover``, ``diff`` and ``export`` as their users call them."""

import os
import shutil
import sys
from pathlib import Path

import pandas as pd
import pytest
from command import forked_fpt as fpt
from command import forked_fpt_json as fpt_json

sys.path.append(str(Path(__file__).parents[1] / "bags"))

from damaged import recording


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    return recording(tmp_path_factory.mktemp("commands") / "bag", 40).parent


@pytest.fixture
def cut(whole, tmp_path):
    path = tmp_path / "cut.mcap"
    data = (whole / "bag_0.mcap").read_bytes()
    third = b"zstd".join(data.split(b"zstd")[:3])  # in the head of the third chunk
    path.write_bytes(third)
    return path


def test_info_says_what_is_missing(cut):
    text = fpt("info", cut).stdout
    assert "was cut in the record that begins at byte" in text.replace("\n", " ")
    assert fpt_json("info", cut)["complete"] is False


def test_recover(cut, tmp_path):
    done = fpt("recover", cut)
    assert done.returncode == 0
    assert "was cut" in done.stderr
    assert "cut-recovered" in done.stdout
    info = fpt_json("info", tmp_path / "cut-recovered")
    assert info["messages"] == 40
    assert info["missing"] == []
    again = fpt("recover", cut)
    assert again.returncode == 2
    assert "exists" in again.stderr


def test_diff(whole, cut, tmp_path):
    shutil.copytree(whole, tmp_path / "same")
    same = fpt("diff", whole, tmp_path / "same")
    assert (same.returncode, same.stdout) == (0, "equal to the last bit\n")
    other = fpt("diff", whole, cut)
    assert other.returncode == 1
    assert "/joint_states: 40 messages, and 20" in other.stdout


def test_export(whole, tmp_path):
    done = fpt_json("export", whole, "--topic", "joint_states", "--out", tmp_path / "x.csv")
    assert done["topics"] == {"/joint_states": 40}
    table = pd.read_csv(tmp_path / "x.csv", index_col=0)
    assert table["joint_states.position.q1 [rad]"].tolist() == [float(k) for k in range(40)]


@pytest.mark.parametrize("command", ["info", "recover", "export", "report"])
def test_bad_recordings_are_one_line(tmp_path, command):
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "text.mcap").write_text("no recording at all")
    for bad in ("pipe", "text.mcap", "nothing"):
        done = fpt(command, bad, cwd=tmp_path)
        assert done.returncode == 2, bad
        assert len(done.stderr.strip().splitlines()) == 1
    assert sorted(os.listdir(tmp_path)) == ["pipe", "text.mcap"]


@pytest.mark.parametrize("command", ["recover", "diff", "export"])
def test_help_has_an_example(command):
    assert f"Example: fpt {command}" in fpt(command, "--help").stdout
