"""Whether this machine is fit for a graph: what is wrong, and what to do."""

import fcntl
import os
import resource
import shutil
import socket
import struct
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from importlib import metadata
from pathlib import Path
from typing import NamedTuple

from fpt_ros.errors import BadInput
from fpt_ros.nodes import shared_memory

OK, WARNING, WRONG = "ok", "warning", "wrong"

DOMAINS = range(233)
"""Those for which Fast DDS has ports."""

SIOCGIFFLAGS = 0x8913
"""netdevice(7): the flags of a network interface, 1 of them: it is up."""

SHM_NEEDED = 4 << 20
"""Bytes in /dev/shm: nodes keep there what those need that are started in their place."""

DISK_NEEDED = 100 << 20

FILES_NEEDED = 256

LOOK = 1.5
"""Seconds in which other nodes are looked for."""


class Finding(NamedTuple):
    """One thing looked at: ``state``, what it is like, and what to do if it is not ok."""

    what: str
    state: str
    text: str
    remedy: str = ""


def findings() -> Iterator[Finding]:
    """All, one after the other; the first that is wrong may be the reason of others."""
    for check in CHECKS:
        try:
            yield check()
        except Exception as error:  # a check that cannot be made is a finding as well
            yield Finding(check.__name__.strip("_"), WARNING, f"cannot be looked at: {error}")


def check_fit() -> None:
    """Before a graph is started or asked: without these it could not even say what is wrong.

    Raises:
        BadInput: what is wrong, and what would be right.
    """
    for check in (_domain, _network):
        found = check()
        if found.state == WRONG:
            raise BadInput(f"{found.what}: {found.text}; {found.remedy}")


def _python() -> Finding:
    version = ".".join(map(str, sys.version_info[:3]))
    fits = sys.version_info[:2] >= (3, 11)
    return Finding("python", OK if fits else WRONG, version, "" if fits else "Python 3.11 or newer")


def _jazzy() -> Finding:
    try:
        import rclpy
    except ImportError as error:
        return Finding("ros", WRONG, f"no rclpy: {error}", "make setup, or source a Jazzy")
    where = Path(rclpy.__file__).parent
    try:
        return Finding("ros", OK, f"wheels, rclpy {metadata.version('ros-jazzy-rclpy')}, {where}")
    except metadata.PackageNotFoundError:
        distribution = os.environ.get("ROS_DISTRO", "unknown")
        state = OK if distribution == "jazzy" else WARNING
        remedy = "" if state == OK else "it was tried with Jazzy alone"
        return Finding("ros", state, f"{distribution}, {where}", remedy)


def _middleware() -> Finding:
    name = os.environ.get("RMW_IMPLEMENTATION", "rmw_fastrtps_cpp")
    known = name == "rmw_fastrtps_cpp"
    remedy = "" if known else "unset RMW_IMPLEMENTATION: it was tried with rmw_fastrtps_cpp alone"
    return Finding("middleware", OK if known else WARNING, name, remedy)


def _domain() -> Finding:
    text = os.environ.get("ROS_DOMAIN_ID", "") or "0"
    if not text.isdigit() or int(text) not in DOMAINS:
        return Finding("domain", WRONG, f"ROS_DOMAIN_ID={text}", "ROS_DOMAIN_ID from 0 to 232")
    return Finding("domain", OK, text)


def _discovery() -> Finding:
    chosen = os.environ.get("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST (chosen by fpt run)")
    known = chosen.split()[0] in ("LOCALHOST", "SUBNET", "OFF", "SYSTEM_DEFAULT")
    if not known:
        return Finding("discovery", WRONG, chosen, "LOCALHOST or SUBNET")
    if chosen == "OFF":
        return Finding("discovery", WARNING, chosen, "no node hears another: LOCALHOST or SUBNET")
    return Finding("discovery", OK, chosen)


def _network() -> Finding:
    asked = struct.pack("256s", b"lo")
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as any_socket:
        answer = fcntl.ioctl(any_socket, SIOCGIFFLAGS, asked)  # /sys may be of another namespace
    up = struct.unpack_from("16xH", answer)[0] & 1
    remedy = "" if up else "ip link set lo up: nodes of one machine need it"
    return Finding("loopback", OK if up else WRONG, "up" if up else "down", remedy)


def _shared_memory() -> Finding:
    free = shutil.disk_usage(shared_memory.FOLDER).free
    left = shared_memory.leftovers()
    text = f"{free >> 20} MB free, {len(left)} leftovers of processes that have ended"
    if free < SHM_NEEDED:
        return Finding("/dev/shm", WARNING, text, f"{SHM_NEEDED >> 20} MB are needed")
    return Finding("/dev/shm", WARNING if left else OK, text, "fpt doctor --fix" if left else "")


def _disk() -> Finding:
    rooms = {path: shutil.disk_usage(path).free for path in (Path.cwd(), tempfile.gettempdir())}
    path, free = min(rooms.items(), key=lambda each: each[1])
    state = OK if free > DISK_NEEDED else WARNING
    text = f"{free >> 20} MB free in {path}"
    return Finding("disk", state, text, "" if state == OK else "recordings need more")


def _files() -> Finding:
    limit = resource.getrlimit(resource.RLIMIT_NOFILE)[0]
    state = OK if limit >= FILES_NEEDED else WARNING
    return Finding("open files", state, str(limit), "" if state == OK else "ulimit -n 1024")


def _clock() -> Finding:
    """Whether the wall clock keeps pace with the steady one."""
    wall, steady = time.time(), time.monotonic()
    time.sleep(0.2)
    apart = abs((time.time() - wall) - (time.monotonic() - steady))
    state = OK if apart < 0.01 else WARNING
    text = f"steady to {1e3 * apart:.1f} ms in 0.2 s"
    return Finding("clock", state, text, "" if state == OK else "it is being set: mind stamps")


def _home() -> Finding:
    folder = Path(os.environ.get("ROS_LOG_DIR") or os.environ.get("ROS_HOME") or Path.home())
    writable = os.access(folder if folder.exists() else folder.parent, os.W_OK)
    text = f"{folder} {'can' if writable else 'cannot'} be written"
    remedy = "" if writable else "ROS_LOG_DIR=/tmp/ros_log"
    return Finding("log folder", OK if writable else WARNING, text, remedy)


def _load() -> Finding:
    cores, load = os.cpu_count() or 1, os.getloadavg()[0]
    text = f"{load:.1f} on {cores} cores"
    busy = load > cores
    return Finding(
        "load", WARNING if busy else OK, text, "real time needs idle cores" if busy else ""
    )


def _priority() -> Finding:
    limit = resource.getrlimit(resource.RLIMIT_RTPRIO)[0]
    may = limit != 0 or os.geteuid() == 0
    text = "may ask for real-time priority" if may else "no real-time priority"
    remedy = "" if may else "rtprio in /etc/security/limits.conf, for --realtime below 5 ms"
    return Finding("priority", OK if may else WARNING, text, remedy)


def _others() -> Finding:
    if _domain().state == WRONG:  # Fast DDS ends the process there
        return Finding("others", WARNING, "not looked for in a domain that there is not")
    from fpt_ros.nodes.asking import graph

    with graph() as asked:
        names = asked.others(LOOK)
    text = f"{len(names)} other nodes{': ' if names else ''}{', '.join(names[:8])}"
    loop = [name for name in names if name.endswith("/plant_simulator")]
    remedy = "use another ROS_DOMAIN_ID or --namespace for a second graph" if loop else ""
    return Finding("others", WARNING if loop else OK, text, remedy)


CHECKS: tuple[Callable[[], Finding], ...] = (
    _python, _jazzy, _middleware, _domain, _discovery, _network, _shared_memory, _disk, _files,
    _clock, _home, _load, _priority, _others,
)  # fmt: skip
