"""``fpt replay`` and ``fpt rerun`` as their users call them."""

import json
import os
import shutil

import pytest
from command import forked_fpt as fpt
from command import forked_fpt_json as fpt_json


@pytest.fixture(scope="module")
def bag(tmp_path_factory):
    path = tmp_path_factory.mktemp("replay") / "vdp"
    fpt_json("simulate", "vdp_rfpt", "--duration", "0.2", "--seed", "3", "--record", path)
    return path


def test_equal(bag):
    for arguments in (("replay", bag, "--node", "parameter_tuner"), ("rerun", bag)):
        found = fpt_json(*arguments)
        assert (found["equal"], found["cycles"], found["first_difference"]) == (True, 200, None)
    done = fpt("rerun", bag)
    assert (done.returncode, done.stdout) == (0, "loop: 200 cycles, equal to the last bit\n")


@pytest.mark.parametrize("setting", ["A=2e-6", "fpt_deformer.A=2e-6"])
def test_with_another_gain(bag, tmp_path, setting):
    node = ("--node", "fpt_deformer", "--set", setting, "--record", tmp_path / "out")
    done = fpt("replay", bag, *node, "--json")
    assert done.returncode == 1
    found = json.loads(done.stdout)
    first = found["first_difference"]
    assert found["equal"] is False
    assert (first["topic"], first["field"], first["cycle"]) == ("/command", "accelerations.q1", 1)
    assert first["recorded"] != first["now"]
    again = fpt("rerun", tmp_path / "out")
    assert again.returncode == 1  # the plant did not follow the new commands
    assert "/joint_states differs first in cycle 2: " in again.stdout
    differs = fpt_json("diff", bag, tmp_path / "out", "--topic", "/joint_states")
    assert differs["equal"] is True
    text = fpt("replay", bag, "--node", "fpt_deformer", "--set", setting).stdout
    assert "messages of 200 cycles differ\n  /command differs first in cycle 1: acc" in text


def test_a_rerun_with_another_gain(bag):
    done = fpt("rerun", bag, "--set", "fpt_deformer.A=2e-6", "--json")
    assert done.returncode == 1
    first = json.loads(done.stdout)["first_difference"]
    assert (first["topic"], first["field"], first["cycle"]) == ("/command", "accelerations.q1", 1)
    for bad, message in (
        ("A=2e-6", "--set A=2e-6: it takes NODE.PARAM=VALUE"),
        ("fpt_deformer.gain=1", "fpt_deformer has no parameter 'gain'"),
    ):
        refused = fpt("rerun", bag, "--set", bad)
        assert refused.returncode == 2
        assert message in refused.stderr


def test_parameters_of_a_recording(bag, tmp_path):
    file = tmp_path / "vdp_rfpt.yaml"
    file.write_text(fpt("info", bag, "--parameters").stdout)
    again = fpt_json("simulate", file, "--record", tmp_path / "again")
    assert again["cycles"] == 200
    assert fpt_json("diff", bag, tmp_path / "again")["equal"] is True


def test_a_cut_recording_says_so(bag, tmp_path):
    data = (bag / "vdp_0.mcap").read_bytes()
    (tmp_path / "cut.mcap").write_bytes(data[: len(data) - 3000])
    done = fpt("replay", tmp_path / "cut.mcap", "--node", "denoiser")
    assert done.returncode == 0
    assert "cut.mcap was cut" in done.stderr
    assert "equal to the last bit" in done.stdout


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (
            ("--node", "deformer"),
            "there is no node 'deformer' to replay: there are",
        ),
        (("--node", "denoiser", "--set", "fpt_deformer.A=1"), "the replay is of denoiser"),
        (("--node", "denoiser", "--set", "A"), "--set A: it takes PARAM=VALUE, as in A=-0.2"),
        (("--node", "fpt_deformer", "--set", "A=strong"), "fpt_deformer.A: 'strong' is not valid"),
        (("--node", "denoiser", "--rate", "1"), "--rate is for --live"),
        (("--node", "denoiser", "--live", "--set", "order=1"), "--set is for a replay in process"),
        (("--node", "denoiser", "--record", "."), "--record . exists"),
        ((), "--node"),
    ],
)
def test_bad_options_are_one_line(bag, options, message):
    done = fpt("replay", bag, *options)
    assert done.returncode == 2
    assert message in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1


@pytest.mark.parametrize("command", [("replay", "--node", "denoiser"), ("rerun",)])
def test_bad_recordings_are_one_line(tmp_path, bag, command):
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "text.mcap").write_text("no recording at all")
    shutil.copytree(bag, tmp_path / "cut")
    file = tmp_path / "cut" / "vdp_0.mcap"
    file.write_bytes(file.read_bytes()[:200])
    for bad in ("pipe", "text.mcap", "nothing", "cut"):
        done = fpt(command[0], bad, *command[1:], cwd=tmp_path)
        assert done.returncode == 2, bad
        assert len(done.stderr.strip().splitlines()) == 1, done.stderr


@pytest.mark.parametrize("command", ["replay", "rerun"])
def test_help_has_an_example(command):
    assert f"Example: fpt {command}" in fpt(command, "--help").stdout
