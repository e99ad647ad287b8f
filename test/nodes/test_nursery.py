"""The process that nodes are forked from: every birth and every end is told, however quick."""

import asyncio
import signal
import sys

import pytest

from fpt_ros.errors import BadInput, RunFailed
from fpt_ros.nodes.child import end
from fpt_ros.nodes.nursery import Nursery

LIVES = ("--ros-args", "-p", "joints:=[q]")
"""Arguments of a denoiser that waits for messages."""


def ended(folder, *arguments, count=1, name="denoiser", kill=None):
    """Children that were started and have ended."""

    async def lives():
        with Nursery() as nursery:
            nursery.listen()
            children = []
            for _ in range(count):
                children.append(await nursery.start(name, arguments, {}, folder, 0))
                if kill is not None:
                    children[-1].send(kill)
            await asyncio.wait([child.end for child in children])
            await end(children)  # they have: nobody is sent a signal
            nursery.ignore()
            return children

    return asyncio.run(lives())


def test_nodes_that_end_at_once(tmp_path):
    children = ended(tmp_path, "--help", count=20)
    assert [child.status for child in children] == [0] * 20
    assert len({child.process for child in children}) == 20


def test_nodes_that_are_killed_at_their_birth(tmp_path):
    children = ended(tmp_path, *LIVES, count=5, kill=signal.SIGKILL)
    assert [child.how() for child in children] == ["the node denoiser was killed by SIGKILL"] * 5


def test_what_a_node_that_fails_has_said_is_kept(tmp_path):
    (child,) = ended(tmp_path, name="nonsense")
    assert child.status == 1
    assert "No module named 'fpt_ros.nodes.nonsense'" in str(child.failure())
    (child,) = ended(tmp_path, "--ros-args", "-p", "method:=nonsense")
    assert child.status == 2
    assert str(child.failure()).startswith("denoiser: ")


def test_asked_to_end_before_it_can_hear_that_it_ends_as_soon_as_it_can(tmp_path):
    (child,) = ended(tmp_path, *LIVES, kill=signal.SIGTERM)
    assert child.status == 0


def test_without_a_ros_one_line_says_what_is_needed(tmp_path, monkeypatch):
    with monkeypatch.context() as patch:
        patch.setitem(sys.modules, "rclpy", None)
        with pytest.raises(BadInput, match="rclpy is not installed: source a Jazzy"):
            Nursery()
    (tmp_path / "rclpy.py").write_text("raise ImportError('librcl.so: cannot open')")
    monkeypatch.setenv("PYTHONPATH", str(tmp_path))
    with pytest.raises(RunFailed, match=r"nurse, has failed: ImportError: librcl.so: cannot op"):
        ended(tmp_path)
