"""Where the processes of a run come from, as who asks for them sees it."""

import asyncio
import json
import os
import signal
import socket
import subprocess
import sys
from collections import deque
from collections.abc import Mapping, Sequence
from importlib.util import find_spec
from pathlib import Path

from fpt_ros.cycle.stages import STAGES
from fpt_ros.errors import BadInput, RunFailed
from fpt_ros.nodes.child import Child, environment
from fpt_ros.nodes.run_folder import VARIABLE

NEEDED = ("rclpy", "setproctitle")
"""Modules without which no node can be started."""

LIBRARIES = ("mujoco", "scipy.interpolate", "scipy.linalg", "scipy.optimize")
"""Imported by some laws only: where this process has needed them, the nodes will."""

Birth = tuple[int, asyncio.Future[int]]
"""A node's process, and the exit status that it will have."""


class Nursery:
    """The process that all nodes of a run are forked from (:mod:`fpt_ros.nodes.nurse`).

    It imports what they need while we do other things. A context: at its end all have gone.
    """

    def __init__(self) -> None:
        """Begin.

        Raises:
            BadInput: what nodes cannot do without is not installed.
        """
        for module in NEEDED:
            if find_spec(module) is None:
                raise BadInput(
                    f"{module} is not installed: source a Jazzy and its packages, or pip install "
                    "'fpt_ros[ros]'"
                )
        ours, theirs = socket.socketpair(socket.AF_UNIX, socket.SOCK_SEQPACKET)
        with theirs:
            self._process = subprocess.Popen(
                [
                    sys.executable,
                    "-P",  # what lies in the current folder is not ours
                    "-m",
                    "fpt_ros.nodes.nurse",
                    str(theirs.fileno()),
                ],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.PIPE,
                env=environment(),
                pass_fds=(theirs.fileno(),),
                start_new_session=True,
            )
        ours.setblocking(False)
        self._channel, self._why = ours, "was ended"
        self._expected: deque[asyncio.Future[Birth]] = deque()
        self._ends: dict[int, asyncio.Future[int]] = {}

    def __enter__(self) -> "Nursery":
        return self

    def __exit__(self, *about: object) -> None:
        self._channel.close()
        self._process.kill()  # it may still be importing; nodes are sent SIGTERM
        self._process.communicate()

    def listen(self) -> None:
        """Hear of births and ends in this event loop from now on."""
        asyncio.get_running_loop().add_reader(self._channel, self._hear)

    def ignore(self) -> None:
        """Hear of nothing any more."""
        asyncio.get_running_loop().remove_reader(self._channel)

    async def start(
        self,
        name: str,
        arguments: Sequence[str],
        descriptors: Mapping[str, int],
        folder: Path,
        began: int,
    ) -> Child:
        """Start a node.

        Args:
            name: of the node, and of its module.
            arguments: ROS's own.
            folder: of the run.
            descriptors: that it inherits, by the environment variables that tell it of them.
            began: cycles that are done.

        Raises:
            RunFailed: the nursery has ended.
        """
        loop = asyncio.get_running_loop()
        lines, output = os.pipe()
        born: asyncio.Future[Birth] = loop.create_future()
        self._expected.append(born)
        order = {
            "name": name,
            "arguments": arguments,
            "environment": {VARIABLE: str(folder)},
            "told": [*descriptors],
            "libraries": [each for each in LIBRARIES if name in STAGES and each in sys.modules],
        }
        try:
            socket.send_fds(
                self._channel, [json.dumps(order).encode()], [output, *descriptors.values()]
            )
            process, ended = await born
        except OSError as error:
            os.close(lines)
            self._expected.pop()
            self._lose()
            raise self._gone() from error
        finally:
            os.close(output)
        reader = asyncio.StreamReader()
        await loop.connect_read_pipe(
            lambda: asyncio.StreamReaderProtocol(reader), os.fdopen(lines, "rb")
        )
        return Child(name, process, ended, reader, began)

    def _hear(self) -> None:
        try:
            data = self._channel.recv(1024)
        except BlockingIOError:
            return
        except OSError:
            data = b""
        if not data:
            self._lose()
            return
        told = json.loads(data)
        process, status = told["pid"], told.get("status")
        if status is None:
            end = self._ends[process] = asyncio.get_running_loop().create_future()
            self._expected.popleft().set_result((process, end))
        else:
            self._ends.pop(process).set_result(status)

    def _lose(self) -> None:
        """It failed, or was ended by somebody: its nodes are sent SIGTERM by the kernel."""
        self.ignore()
        assert self._process.stderr is not None
        said = self._process.stderr.read().decode(errors="replace").splitlines()
        if said:
            self._why = f"has failed: {said[-1]}"
        for born in self._expected:
            born.set_exception(self._gone())
        for end in self._ends.values():
            end.set_result(-signal.SIGTERM)
        self._expected.clear()
        self._ends.clear()

    def _gone(self) -> RunFailed:
        name = "the process that starts the nodes, fpt_ros.nodes.nurse,"
        return RunFailed(f"{name} {self._why}")
