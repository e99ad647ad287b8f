"""Every test has a ROS domain of its own, on this machine only: tests run side by side."""

import fcntl
import gc
import signal
import tempfile
from pathlib import Path

import command
import made_runs
import pytest
import samples
from hypothesis import settings

from fpt_ros.nodes import middleware

DOMAINS = range(1, 101)
"""Those whose ports lie below the range that Linux hands out."""


def pytest_addoption(parser):
    parser.addoption("--all", action="store_true", help="exhaustive tests take no sample")


def pytest_configure(config):
    # started in the background Ctrl-C is ignored, also by the commands that tests start
    signal.signal(signal.SIGINT, signal.default_int_handler)
    samples.whole = config.getoption("--all")
    # a thousand tests leave so much that a tenth of the time went into searches for garbage
    gc.set_threshold(100_000, 50, 100)
    # no deadlines: a busy machine is slow at random
    settings.register_profile("sample", derandomize=True, deadline=None)
    settings.register_profile("whole", deadline=None)
    settings.load_profile("whole" if samples.whole else "sample")


@pytest.fixture(autouse=True)
def ros_domain(monkeypatch):
    """A domain that no other test of this machine has, whichever run it belongs to."""
    folder = Path(tempfile.gettempdir()) / "fpt_ros_test_domains"
    folder.mkdir(exist_ok=True)
    for domain in DOMAINS:
        with (folder / str(domain)).open("w") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                continue
            monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
            monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
            for chosen in (middleware.PROFILES, middleware.TRANSPORTS):
                monkeypatch.setenv(chosen, "")  # undone at the end, whoever sets it
                monkeypatch.delenv(chosen)
            yield domain
            command.end_started()  # before another test may have the domain
            return
    pytest.fail("all ROS domains are in use by other tests")


@pytest.fixture(scope="session")
def make():
    """A run of an experiment: ``make(name, variant, duration)``."""
    return made_runs.made


@pytest.fixture(scope="session")
def shorten():
    """What a recording killed after some cycles would hold."""
    return made_runs.cut


@pytest.fixture(scope="session")
def hand_made():
    """A run of numbers given by hand."""
    return made_runs.by_hand
