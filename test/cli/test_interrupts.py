"""Ctrl-C at any time: one line, status 130, nothing left behind."""

import os
import subprocess
import sys

import pytest

from fpt_ros.bags.reader import info

TIMEOUT = 120.0

AT_IMPORT = """
import os, signal, sys
class Interrupt:
    def find_spec(self, name, path=None, target=None):
        if name == at:
            os.kill(os.getpid(), signal.SIGINT)
at = sys.argv.pop(1)
sys.meta_path.insert(0, Interrupt())
from fpt_ros.cli.main import main
main()
"""
"""The command, which is interrupted when it imports a module."""

AT_COMPILATION = """
import os, signal, sys
from numba.core import event
class Interrupt(event.Listener):
    def on_start(self, event):
        os.kill(os.getpid(), signal.SIGINT)
    def on_end(self, event):
        pass
event.register("numba:compile", Interrupt())
from fpt_ros.cli.main import main
main()
"""
"""The command, which is interrupted where numba has begun to compile, and swallows exceptions."""


def interrupted(script, *words, **environment):
    return subprocess.run(
        [sys.executable, "-c", script, *map(str, words)],
        capture_output=True,
        text=True,
        timeout=TIMEOUT,
        env={**os.environ, **{key: str(value) for key, value in environment.items()}},
        check=False,
    )


def is_quiet(done):
    assert done.returncode == 130, done.stderr
    assert done.stderr.splitlines()[-1] == "fpt: interrupted"
    assert "Traceback" not in done.stderr
    assert done.stdout == ""


@pytest.mark.parametrize(
    ("module", "command"),
    [
        ("typer", "run"),  # the first that takes its time
        ("fpt_ros.cli.watch", "simulate"),  # the last command
        ("numpy", "simulate"),
        ("fpt_ros.nodes.graph", "run"),
    ],
)
def test_while_it_starts(tmp_path, module, command):
    temporary = tmp_path / "temporary"
    temporary.mkdir()
    bag = tmp_path / "bag"
    is_quiet(interrupted(AT_IMPORT, module, command, "tora", "--record", bag, TMPDIR=temporary))
    assert list(temporary.iterdir()) == []
    assert not bag.exists()


def test_while_laws_are_compiled(tmp_path):
    """The recording is open then."""
    bag = tmp_path / "bag"
    is_quiet(
        interrupted(
            AT_COMPILATION, "simulate", "tora", "--record", bag, XDG_CACHE_HOME=tmp_path / "cache"
        )
    )
    assert info(bag)["reason"] == "interrupted in cycle 0"
    assert not list(tmp_path.rglob("*.nbi"))
