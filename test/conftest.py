"""Every test has a ROS domain of its own, on this machine only: tests run side by side."""

import itertools
import os

import pytest

_PER_WORKER = 40
_COUNTER = itertools.count()


@pytest.fixture(autouse=True)
def ros_domain(monkeypatch):
    worker = int(os.environ.get("PYTEST_XDIST_WORKER", "gw0").removeprefix("gw"))
    domain = 1 + (worker * _PER_WORKER + next(_COUNTER) % _PER_WORKER) % 100
    monkeypatch.setenv("ROS_DOMAIN_ID", str(domain))
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    monkeypatch.setenv("FASTDDS_BUILTIN_TRANSPORTS", "UDPv4")
    return domain
