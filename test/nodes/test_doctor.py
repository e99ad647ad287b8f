"""``fpt doctor``: what it finds, and what it says to do."""

import os
import uuid
from pathlib import Path

import pytest
from command import forked_fpt, forked_fpt_json

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
