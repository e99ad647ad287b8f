"""A whole graph says where it runs, and does not start where another one does."""

import os

import pytest

from fpt_ros.errors import RunFailed
from fpt_ros.nodes import run_folder


@pytest.fixture
def domain(monkeypatch):
    monkeypatch.setenv("ROS_DOMAIN_ID", f"test-{os.getpid()}")


@pytest.fixture
def running(domain):
    """The folder of a run that goes on in the namespace ``robot``."""
    with run_folder.made() as folder, run_folder.claimed(folder, "robot"):
        yield folder


def claim(namespace):
    with run_folder.made() as folder, run_folder.claimed(folder, namespace):
        pass


def test_a_second_graph_is_refused(running):
    with pytest.raises(RunFailed, match=f"process {os.getpid()} runs a graph .* ROS_DOMAIN_ID"):
        claim("/robot/")


@pytest.mark.parametrize("namespace", ["", "robot2", "robot/arm", "*"])
def test_another_namespace_is_free(running, namespace):
    claim(namespace)


def test_another_domain_is_free(running, monkeypatch):
    monkeypatch.setenv("ROS_DOMAIN_ID", "test-other")
    claim("robot")


def test_a_run_that_is_over_is_in_nobodys_way(domain):
    for _ in range(2):
        claim("robot")


def test_a_run_that_was_killed_is_in_nobodys_way_even_if_its_number_is_anothers(domain):
    """Its folder is left, named after a process that is there: this one."""
    with run_folder.made() as left:
        with run_folder.claimed(left, "robot"):
            pass
        assert list(left.glob("*.graph"))
        claim("robot")
