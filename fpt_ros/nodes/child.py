"""A process of the graph: how it is started, what it says last, and how it ends."""

import asyncio
import json
import os
import signal
import socket
import subprocess
import sys
import tempfile
from collections import deque
from collections.abc import Mapping, Sequence
from contextlib import suppress
from importlib.util import find_spec
from pathlib import Path

from fpt_ros.cycle.stages import STAGES
from fpt_ros.errors import BadInput, FptError, RunFailed
from fpt_ros.nodes.run_folder import VARIABLE

NEEDED = ("rclpy", "setproctitle")

GRACE = 1.2
"""Seconds that a process has to end when asked to, before it is killed."""

LAST_LINES = 12

LIBRARIES = ("mujoco", "scipy.interpolate", "scipy.linalg", "scipy.optimize")
"""Imported by some laws only: where this process has needed them, the nodes will."""


Birth = tuple[int, asyncio.Future[int]]
"""A node's process, and the exit status that it will have."""


class Nursery:
    """The process that all nodes of a run are forked from (:mod:`fpt_ros.nodes.nursery`).

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
                    "fpt_ros.nodes.nursery",
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
    ) -> "Child":
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
        name = "the process that starts the nodes, fpt_ros.nodes.nursery,"
        return RunFailed(f"{name} {self._why}")


class Child:
    """A process that has been started.

    Attributes:
        name: of the node.
        process: its number.
        began: cycles of the run that were done then.
        spread: whether it runs on any core yet.
        status: exit status; less than 0: the signal that killed it; None: it runs.
        end: done when the process has ended, and its last lines are read.
    """

    def __init__(
        self,
        name: str,
        process: int,
        ended: asyncio.Future[int],
        output: asyncio.StreamReader,
        began: int,
    ) -> None:
        self.name, self.process, self.began = name, process, began
        self.spread = True
        self.status: int | None = None
        self._lines: deque[str] = deque(maxlen=LAST_LINES)
        self._exit, self._output = ended, output
        self.end = asyncio.create_task(self._ended())

    async def _ended(self) -> None:
        while line := await self._output.readline():
            self._lines.append(line.decode(errors="replace").rstrip())
        self.status = await self._exit

    def send(self, number: signal.Signals) -> None:
        """Send a signal, if it has not ended."""
        if not self._exit.done():
            with suppress(ProcessLookupError):
                os.kill(self.process, number)

    def how(self) -> str:
        """How it has ended."""
        status = self.status or 0
        end = f"was killed by {signal.Signals(-status).name}" if status < 0 else f"ended ({status})"
        return f"the node {self.name} {end}"

    def failure(self) -> FptError:
        """What to say of its end."""
        own = [line for line in self._lines if line.startswith(f"{self.name}: ")]
        if own and self.status == BadInput.exit_status:
            return BadInput(own[-1])
        if own and self.status == RunFailed.exit_status:
            return RunFailed(own[-1])
        last = "".join(f"\n  {line}" for line in self._lines) or " nothing"
        return RunFailed(f"{self.how()}; its last lines:{last}")


def environment() -> Mapping[str, str]:
    """Environment of the processes.

    Unless the user has chosen otherwise, nobody on the network hears us. Where the home cannot be
    written, logs go to the folder of temporary files.
    """
    defaults = {
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        "PYTHONUNBUFFERED": "1",
        "RCUTILS_LOGGING_USE_STDOUT": "0",
    }
    if not {"ROS_LOG_DIR", "ROS_HOME"} & os.environ.keys():
        try:
            (Path.home() / ".ros" / "log").mkdir(parents=True, exist_ok=True)
        except OSError:
            defaults["ROS_LOG_DIR"] = str(Path(tempfile.gettempdir()) / f"ros_log_{os.getuid()}")
    return {**defaults, **os.environ}


async def end(children: Sequence[Child], grace: float = GRACE) -> None:
    """Ask processes to end, and kill those that do not."""
    running = [child for child in children if child.status is None]
    for child in running:
        child.send(signal.SIGTERM)
    if not running:
        return
    _, late = await asyncio.wait([child.end for child in running], timeout=grace)
    if late:
        for child in running:
            if child.status is None:
                child.send(signal.SIGKILL)
        await asyncio.wait(late)
