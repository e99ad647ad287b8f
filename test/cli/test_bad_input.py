"""Bad input: one line that says what is wrong and what is valid, status 2, nothing left behind."""

import pytest
from command import forked_fpt

CASES = [
    (["simulate", "tor"], "no experiment 'tor': there are acrobot, affine_map, cart_beam_hamper, "),
    (["run", "tor"], "no experiment 'tor': there are acrobot, affine_map, cart_beam_hamper, "),
    (
        ["simulate", "tora", "--variant", "x"],
        "tora has no variant 'x': it has adaptive, chatter, ",
    ),
    (["run", "tora", "--variant", "x"], "tora has no variant 'x': it has adaptive, chatter, "),
    *(
        ([command, "tora", "--variant", "none.yaml"], "none.yaml cannot be read: No such file")
        for command in ("simulate", "run", "gain")
    ),
    (
        ["sweep", "tora", "--variant", "none.yaml", "--grid", "fpt_deformer.A=-1,-2"],
        "none.yaml cannot be read: No such file",
    ),
    (
        ["tune", "tora", "--variant", "none.yaml", "--over", "fpt_deformer.A"],
        "none.yaml cannot be read: No such file",
    ),
    (["simulate", "tora", "--set", "foo.A=1"], "there is no node 'foo': there are plant_simulator"),
    (
        ["simulate", "tora", "--set", "fpt_deformer.Q=1"],
        "fpt_deformer has no parameter 'Q': it has A",
    ),
    (["simulate", "tora", "--set", "fpt_deformer.A"], "it takes NODE.PARAM=VALUE"),
    (["simulate", "tora", "--set", "fpt_deformer.A=high"], "fpt_deformer.A: 'high' is not valid"),
    (["simulate", "tora", "--set", "fpt_deformer.A=[1"], "is not a YAML value"),
    (["simulate", "tora", "--set", "fpt_deformer.K=-1"], "it takes a number > 0 and <= 2"),
    (["simulate", "tora", "--set", "fpt_deformer.K=1.99"], "give no fixed point"),
    (
        ["simulate", "tora", "--set", "fpt_deformer.transformation=x"],
        "none, atanh, rfpt, rotation, sgfpt",
    ),
    (["simulate", "tora", "--set", "plant_simulator.dt=0"], "plant_simulator.dt: 0 is not valid"),
    (["simulate", "tora", "--set", "plant_simulator.dt=1e-10"], "whole number of nanoseconds"),
    (["simulate", "tora", "--duration", "0"], "plant_simulator.duration: 0.0 is not valid"),
    (["run", "tora", "--duration", "-1"], "plant_simulator.duration: -1.0 is not valid"),
    (["simulate", "tora", "--duration", "long"], "Invalid value for '--duration'"),
    (["simulate", "tora", "--seed", "-1"], "plant_simulator.seed: -1 is not valid"),
    (["run", "tora", "--namespace", "a b"], "'a b' is not a ROS namespace"),
    (["run", "tora", "--namespace", "a" * 300], "--namespace of 300 letters: at most 180"),
    (["pause", "--namespace", "a" * 300], "--namespace of 300 letters: at most 180"),
    (["run", "tora", "--namespace", "\u00e9"], "is not a ROS namespace"),
    (["simulate", "no/such.yaml"], "no/such.yaml cannot be read: No such file or directory"),
    (["simulate", "tora", "--record", "/proc/x"], "give a directory that can be created"),
    (["simulate"], "Missing argument 'NAME'"),
    (["simulate", "tora", "--colour"], "No such option"),
    (["frobnicate"], "No such command 'frobnicate'"),
    (["info", "no_bag"], "no_bag"),
    (["report", "no_bag"], "no_bag"),
    (["report", "no_bag", "--format", "gif"], "--format gif: it has to be one of svg, pdf, png"),
]


@pytest.mark.parametrize(("arguments", "complaint"), CASES, ids=lambda c: " ".join(c)[:50])
def test_one_line_and_status_2(tmp_path, arguments, complaint):
    done = forked_fpt(*arguments, cwd=tmp_path)
    assert done.returncode == 2, done.stderr
    assert complaint in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1
    assert done.stdout == ""
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("command", ["simulate", "run"])
def test_existing_directory_is_not_touched(tmp_path, command):
    (tmp_path / "bag").mkdir()
    done = forked_fpt(command, "tora", "--record", "bag", cwd=tmp_path)
    assert done.returncode == 2
    assert "--record bag exists" in done.stderr
    assert list((tmp_path / "bag").iterdir()) == []


@pytest.mark.parametrize(
    ("text", "complaint"),
    [
        ("a: [1, 2", "is not YAML"),
        ("- 1\n- 2", "is not a ROS 2 parameter file"),
        ("denoiser: {method: none}", "has to hold a map 'ros__parameters'"),
        ("denoiser: {ros__parameters: {method: none}}", "lacks the section 'plant_simulator'"),
    ],
)
def test_bad_parameter_files(tmp_path, text, complaint):
    (tmp_path / "my.yaml").write_text(text)
    done = forked_fpt("simulate", "my.yaml", cwd=tmp_path)
    assert done.returncode == 2
    assert complaint in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1


def test_not_a_recording(tmp_path):
    (tmp_path / "notes.mcap").write_text("hello")
    done = forked_fpt("info", "notes.mcap", cwd=tmp_path)
    assert done.returncode == 2
    assert "notes.mcap" in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1
