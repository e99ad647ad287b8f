"""The private folder of a run: what its nodes keep for those that are started in their place.

``fpt run`` makes it in memory where it can, tells its processes by an environment variable, and
removes it at the end. Nodes that are started by hand have none, and keep nothing.
"""

import fcntl
import glob
import os
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from fpt_ros.errors import RunFailed
from fpt_ros.nodes import shared_memory
from fpt_ros.nodes.shared_memory import FOLDER, RUN_FOLDER

VARIABLE = "FPT_RUN_FOLDER"

_GID = ".gid"


@contextmanager
def made() -> Iterator[Path]:
    """Make the folder of a run, for its user alone."""
    shared_memory.remove(shared_memory.left_folders())
    in_memory = FOLDER if os.access(FOLDER, os.W_OK | os.X_OK) else None
    prefix = RUN_FOLDER.format(os.getpid())
    with tempfile.TemporaryDirectory(prefix=prefix, dir=in_memory) as folder:
        yield Path(folder)


@contextmanager
def claimed(folder: Path, namespace: str) -> Iterator[None]:
    """Say that a whole graph runs here. Its nodes would find another one too, but that may be late.

    A lock says so, which goes with this process however that ends; its number may soon be another
    one's, and the folder of a run that has just ended be half removed.

    Raises:
        RunFailed: there is one in this network, ROS domain and namespace.
    """
    network = os.readlink("/proc/self/ns/net")
    parts = network, os.environ.get("ROS_DOMAIN_ID", "0"), namespace.strip("/").replace("/", "~")
    name = "~".join(parts) + ".graph"
    with (folder / name).open("w") as mine:
        fcntl.flock(mine, fcntl.LOCK_EX)
        for other in FOLDER.glob(RUN_FOLDER.format("*") + f"*/{glob.escape(name)}"):
            if other.parent != folder and _is_locked(other):
                raise RunFailed(
                    f"process {other.parent.name.split('-')[1]} runs a graph in this ROS domain "
                    "and namespace: use another ROS_DOMAIN_ID or --namespace"
                )
        yield


def _is_locked(path: Path) -> bool:
    """Whether a process holds this file; another user's counts as held."""
    try:
        with path.open() as file:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except FileNotFoundError:
        return False
    except OSError:
        return True
    return False


def mine() -> Path | None:
    """The folder of the run that this process belongs to."""
    given = os.environ.get(VARIABLE)
    return Path(given) if given else None


def introduce(topic: str, gid: bytes) -> None:
    """Say, before it publishes, that this publisher of ``topic`` (absolute name) is the run's own.

    Who has listened to the one that was killed knows by this whom to listen to now.
    """
    folder = mine()
    if folder is not None and gid:
        (folder / f"{gid.hex()}{_suffix(topic)}").touch()


def own_publishers(topic: str) -> set[bytes]:
    """GIDs of the publishers of ``topic`` that the run has had; empty: they are not known."""
    folder = mine()
    if folder is None:
        return set()
    suffix = _suffix(topic)
    return {bytes.fromhex(path.name.removesuffix(suffix)) for path in folder.glob(f"*{suffix}")}


def mark(step: str) -> bool:
    """Note that a step is taken; true: a process before this one has taken it already."""
    folder = mine()
    if folder is None:
        return False
    path = folder / f"{step}.mark"
    taken = path.exists()
    path.touch()
    return taken


def is_marked(step: str) -> bool:
    """Whether a process of this run has taken a step."""
    folder = mine()
    return folder is not None and (folder / f"{step}.mark").exists()


def _suffix(topic: str) -> str:
    return topic.replace("/", "~") + _GID
