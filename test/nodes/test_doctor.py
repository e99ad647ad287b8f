"""``fpt doctor``: what it finds, and what it says to do."""

import os
import shutil
import uuid
from pathlib import Path

import pytest
from command import forked_fpt, forked_fpt_json

from fpt_ros.nodes.shared_memory import RUN_FOLDER, left_folders, remove

LEFTOVER = Path("/dev/shm")


@pytest.fixture
def leftover():
    """What Fast DDS leaves of a process that was killed."""
    path = LEFTOVER / f"fastrtps_{uuid.uuid4().hex[:16]}"
    path.write_bytes(b"x")
    yield path
    path.unlink(missing_ok=True)


def states(found):
    return {each["what"]: each["state"] for each in found["findings"]}


def test_a_machine_that_runs_these_tests_is_fit():
    found = states(forked_fpt_json("doctor"))
    assert set(found) > {"python", "ros", "domain", "/dev/shm", "others", "clock"}
    assert "wrong" not in found.values()


def test_a_domain_that_there_is_not(monkeypatch):
    monkeypatch.setenv("ROS_DOMAIN_ID", "999")
    done = forked_fpt("doctor")
    assert done.returncode == 1
    assert "ROS_DOMAIN_ID from 0 to 232" in done.stdout


def test_leftovers_are_named_and_removed_those_in_use_are_not(leftover):
    used = LEFTOVER / f"fastrtps_{uuid.uuid4().hex[:16]}"
    with used.open("wb"):
        assert forked_fpt("doctor", "--fix").returncode == 0
        assert not leftover.exists()
        assert used.exists()
    os.unlink(used)


def test_folders_of_runs_that_were_killed():
    """By the process in their names: what is used by one that lives stays."""
    gone = next(n for n in range(2**22, 2**22 + 1000) if not Path(f"/proc/{n}").exists())
    left, used = (LEFTOVER / RUN_FOLDER.format(n) for n in (gone, os.getpid()))
    for folder in (left, used):
        folder.mkdir()
        (folder / "denoiser.state").write_bytes(b"x")
    try:
        assert left_folders() >= {left}
        assert used not in left_folders()
        remove(left_folders() & {left})
        assert not left.exists()
    finally:
        for folder in (left, used):
            shutil.rmtree(folder, ignore_errors=True)
