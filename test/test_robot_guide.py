"""The guide "your robot in ten minutes" does what it says."""

import re
import shlex
from pathlib import Path

import pytest
from command import forked_fpt

GUIDE = Path(__file__).parents[1] / "docs" / "guides" / "robot.md"


def blocks(kind):
    return re.findall(rf"```{kind}\n(.*?)```", GUIDE.read_text(encoding="utf-8"), re.S)


def test_every_command_of_the_guide_works_and_prints_what_stands_there(tmp_path):
    pytest.importorskip("mujoco")
    (text,) = blocks("xml")
    (tmp_path / "arm.urdf").write_text(text)
    commands = [shlex.split(line) for block in blocks("sh") for line in block.splitlines()]
    assert [command[1] for command in commands] == ["robot", "simulate", "report", "compare"]
    printed = []
    for _, *arguments in commands:
        done = forked_fpt(*arguments, cwd=tmp_path)
        assert done.returncode == 0, done.stderr
        printed.append(done.stdout)
    (shown,) = blocks("text")
    assert [line.rstrip() for line in printed[0].splitlines()] == shown.splitlines()
    report = (tmp_path / "arm" / "report" / "index.html").read_text()
    assert 'src="data:image/webp;base64,' in report
    page = (tmp_path / "arm" / "compare" / "index.html").read_text()
    for name in ("adaptive", "computed_torque", "momentum_observer", "pickup"):
        assert name in page


def test_the_indented_command_is_one(tmp_path):
    (line,) = re.findall(r"^    (fpt .*)$", GUIDE.read_text(encoding="utf-8"), re.M)
    assert line.startswith("fpt compare arm/arm.yaml --tune")
    help_text = forked_fpt("compare", "--help").stdout
    assert "--tune" in help_text
    assert "--hold" in help_text
