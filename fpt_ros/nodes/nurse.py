"""The process that all nodes of a run are forked from: it has imported what they need.

Most of a node's start are imports; forked it takes a fifth of the time, and shares their memory.
Threads are not forked, so that rclpy is initialised in the node itself; those that libraries start
when they are loaded (OpenBLAS, which knows of forks, and LTTng, which waits for a tracer) are not
missed: whoever traces nodes starts them by hand or by launch.

Orders come in through a socket as JSON, with the descriptors that the node inherits, first that of
its output. What goes out: ``{"pid"}`` of the node that was born, and ``{"pid", "status"}`` of each
that has ended. Without anybody at the other end of the socket this process ends, and the nodes with
it.
"""

import ctypes
import gc
import importlib
import json
import os
import select
import signal
import socket
import sys
import traceback
import warnings
from collections.abc import Sequence
from contextlib import suppress
from typing import Any

from fpt_ros.cycle.stages import STAGES
from fpt_ros.experiments.description import NODE as RECORDER
from fpt_ros.nodes.loop_node import message_class
from fpt_ros.nodes.side_topics import SIDE_TOPICS

LONGEST = 65536
"""Bytes of an order at most."""

INHERITED = 8
"""Descriptors with an order at most."""

PR_SET_PDEATHSIG = 1

MODULES = (*STAGES, RECORDER, "composed")
"""Of this package, each with a ``main``."""

TYPES = (
    "builtin_interfaces/msg/Time",
    "lifecycle_msgs/msg/TransitionEvent",
    "lifecycle_msgs/srv/ChangeState",
    "rcl_interfaces/srv/GetParameters",
    "sensor_msgs/msg/JointState",
    "std_msgs/msg/UInt8MultiArray",
    "std_srvs/srv/Trigger",
    "trajectory_msgs/msg/JointTrajectoryPoint",
    "type_description_interfaces/srv/GetTypeDescription",
)
"""One of each package of messages: it brings the others, and what is needed to read them."""


def prepare() -> None:
    """Import what nodes import, now or when they are made."""
    for name in MODULES:
        importlib.import_module(f"fpt_ros.nodes.{name}")
    for each in (*TYPES, *SIDE_TOPICS.values()):
        type(message_class(each)).__import_type_support__()
    gc.freeze()  # what is never garbage is not looked at, and so stays shared


class Nurse:
    """Forks nodes and says how they end."""

    def __init__(self, channel: socket.socket) -> None:
        self._channel = channel
        self._children: dict[int, int] = {}  # by their process descriptors
        self._poll = select.poll()
        self._poll.register(channel, select.POLLIN)

    def serve(self) -> None:
        """Until nobody is at the other end; in a node, until it ends."""
        while True:
            for descriptor, _ in self._poll.poll():
                if descriptor != self._channel.fileno():
                    self._bury(descriptor)
                    continue
                order, inherited, _, _ = socket.recv_fds(self._channel, LONGEST, INHERITED)
                if not order:
                    return
                self._fork(inherited, **json.loads(order))

    def _fork(self, inherited: list[int], libraries: Sequence[str], **node: Any) -> None:
        for name in libraries:
            importlib.import_module(name)
        parent, child = os.getpid(), os.fork()
        if child == 0:
            self._channel.close()
            for descriptor in self._children:
                os.close(descriptor)
            become(parent, inherited, **node)
        for descriptor in inherited:
            os.close(descriptor)
        watched = os.pidfd_open(child)
        self._poll.register(watched, select.POLLIN)
        self._children[watched] = child
        self._tell(pid=child)

    def _bury(self, watched: int) -> None:
        child = self._children.pop(watched)
        self._poll.unregister(watched)
        os.close(watched)
        status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
        self._tell(pid=child, status=status)

    def _tell(self, **message: int) -> None:
        with suppress(OSError):  # nobody is there: so says the next look at the channel, too
            self._channel.send(json.dumps(message).encode())


def become(
    parent: int,
    inherited: list[int],
    name: str,
    arguments: list[str],
    environment: dict[str, str],
    told: list[str],
) -> None:
    """Be the node ``name``, in a session of its own; it does not come back.

    Args:
        parent: this process before the fork; when it ends the node is sent SIGTERM.
        inherited: descriptors; the first takes what the node writes.
        name, arguments: module and what would stand on its command line.
        environment: variables to set.
        told: environment variables that tell of the other descriptors.
    """
    from setproctitle import setproctitle, setthreadtitle

    os.setsid()
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
    if os.getppid() != parent:
        os._exit(1)
    for standard in (1, 2):
        os.dup2(inherited[0], standard)
    os.close(inherited[0])
    os.environ.update(environment)
    os.environ.update(zip(told, map(str, inherited[1:]), strict=True))
    sys.argv = [name, *arguments]
    setproctitle(" ".join([name, *arguments]))
    setthreadtitle(name)
    status: object = 1
    try:
        importlib.import_module(f"fpt_ros.nodes.{name}").main()
    except SystemExit as end:
        status = end.code
    except BaseException:
        traceback.print_exc()
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status if isinstance(status, int) else 0 if status is None else 1)


def main() -> None:
    """``python -m fpt_ros.nodes.nurse SOCKET``."""
    # asked to end while it starts, a node does so as soon as it can hear that
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTERM})
    warnings.filterwarnings("ignore", ".*multi-threaded", DeprecationWarning)  # of Python 3.12
    channel = socket.socket(fileno=int(sys.argv[1]))
    prepare()
    Nurse(channel).serve()


if __name__ == "__main__":
    main()
