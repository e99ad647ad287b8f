"""``fpt reproduce``: a command of the page repeats its run, and Ctrl-C leaves nothing behind."""

import json
import shlex
import signal

import psutil
from command import forked_fpt, start_fpt

from fpt_ros.thesis.chapters import chapters


def test_a_command_of_a_claim_repeats_its_run():
    claims = [claim for chapter in chapters().values() for claim in chapter.claims.values()]
    setup = next(one for claim in claims for one in claim.runs.values() if one.settings)
    done = forked_fpt(*shlex.split(setup.command())[1:], "--json")
    assert done.returncode in (0, 1), done.stderr
    assert json.loads(done.stdout)["experiment"] == setup.name


def test_interrupted_it_leaves_nothing_behind(tmp_path):
    process = start_fpt("reproduce", "--chapter", 2, "--out", tmp_path / "out")
    parent = psutil.Process(process.pid)
    assert process.stderr.readline().startswith("reproduce:")  # the workers have been asked for
    children = parent.children(recursive=True)
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)
    assert process.returncode == 130
    _, alive = psutil.wait_procs(children, timeout=10)
    assert not alive
    assert not (tmp_path / "out" / "index.html").exists()
