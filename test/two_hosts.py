"""Two hosts on one machine: network namespaces with a cable between them.

They share a machine id and /dev/shm: shared memory would talk past the cable.
"""

import ctypes
import os
import subprocess
from contextlib import contextmanager
from pathlib import Path

import pytest

CLONE_NEWNET = 0x40000000
ENVIRONMENT = {
    "ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET",
}


class TwoHosts:
    """``addresses`` of both; what is started ``on(0)`` or ``on(1)`` lives there."""

    addresses = ("10.99.77.1", "10.99.77.2")

    def __init__(self):
        self.names = [f"fpt{os.getpid()}{side}" for side in "ab"]

    def open(self):
        for name in self.names:
            _ip("netns", "add", name)
            _ip("-n", name, "link", "set", "lo", "up")
        one, other = self.names
        _ip("link", "add", "cable", "netns", one, "type", "veth", "peer", "cable", "netns", other)
        for name, address in zip(self.names, self.addresses, strict=True):
            _ip("-n", name, "addr", "add", f"{address}/24", "dev", "cable")
            _ip("-n", name, "link", "set", "cable", "up")

    def close(self):
        for name in self.names:
            subprocess.run(["ip", "netns", "del", name], capture_output=True, check=False)

    def cut(self):
        """Pull the cable out."""
        _ip("-n", self.names[0], "link", "set", "cable", "down")

    def mend(self):
        """Put it in again."""
        _ip("-n", self.names[0], "link", "set", "cable", "up")

    @contextmanager
    def on(self, side):
        """This thread, and what it starts, is on one of the hosts."""
        home = os.open("/proc/thread-self/ns/net", os.O_RDONLY)
        there = os.open(Path("/run/netns", self.names[side]), os.O_RDONLY)
        try:
            _enter(there)
            yield
        finally:
            _enter(home)
            os.close(there)
            os.close(home)


@contextmanager
def two_hosts():
    """Two hosts, or the test is skipped with the reason."""
    hosts = TwoHosts()
    try:
        hosts.open()
    except (OSError, subprocess.CalledProcessError) as error:
        hosts.close()
        reason = (getattr(error, "stderr", None) or str(error)).strip()
        pytest.skip(f"no network namespaces here: {reason}")
    try:
        yield hosts
    finally:
        hosts.close()


def _ip(*words):
    subprocess.run(["ip", *words], check=True, capture_output=True, text=True)


def _enter(descriptor):
    if ctypes.CDLL(None, use_errno=True).setns(descriptor, CLONE_NEWNET):
        raise OSError(ctypes.get_errno(), "setns")
