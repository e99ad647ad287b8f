"""A process of the graph: how it is started, what it says last, and how it ends."""

import asyncio
import ctypes
import os
import signal
import sys
import tempfile
from collections import deque
from collections.abc import Mapping, Sequence
from pathlib import Path

from fpt_ros.errors import BadInput, FptError, RunFailed
from fpt_ros.nodes.run_folder import VARIABLE

GRACE = 1.2
"""Seconds that a process has to end when asked to, before it is killed."""

LAST_LINES = 12
PR_SET_PDEATHSIG = 1


class Child:
    """A process that has been started.

    Attributes:
        name: of the node.
        began: cycles of the run that were done then.
        spread: whether it runs on any core yet.
        end: done when the process has ended, and its last lines are read.
    """

    def __init__(self, name: str, process: asyncio.subprocess.Process, began: int) -> None:
        self.name, self.process, self.began = name, process, began
        self.spread = True
        self._lines: deque[str] = deque(maxlen=LAST_LINES)
        self.end = asyncio.create_task(self._ended())

    async def _ended(self) -> None:
        stdout = self.process.stdout
        assert stdout is not None
        while line := await stdout.readline():
            self._lines.append(line.decode(errors="replace").rstrip())
        await self.process.wait()

    @property
    def status(self) -> int | None:
        """Exit status; less than 0: the signal that killed it; None: it runs."""
        return self.process.returncode

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


async def started(
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
        descriptors: that it inherits, by the environment variables that tell it of them.
        folder: of the run.
        began: cycles that are done.
    """
    told = {key: str(descriptor) for key, descriptor in descriptors.items()}
    process = await asyncio.create_subprocess_exec(
        sys.executable,
        "-P",  # what lies in the current folder is not ours
        "-m",
        f"fpt_ros.nodes.{name}",
        *arguments,
        stdin=asyncio.subprocess.DEVNULL,
        stdout=asyncio.subprocess.PIPE,
        stderr=asyncio.subprocess.STDOUT,
        env={**environment(), VARIABLE: str(folder), **told},
        pass_fds=tuple(descriptors.values()),
        start_new_session=True,
        preexec_fn=_before_it_starts,
    )
    return Child(name, process, began)


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


def _before_it_starts() -> None:
    """In the child: SIGTERM when the parent is gone, however it went; it waits until it is heard.

    A recorder that is asked to end while it imports would be killed by it, its file not closed.
    """
    ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, signal.SIGTERM)
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGTERM})


async def end(children: Sequence[Child], grace: float = GRACE) -> None:
    """Ask processes to end, and kill those that do not."""
    running = [child for child in children if child.status is None]
    for child in running:
        child.process.terminate()
    if not running:
        return
    _, late = await asyncio.wait([child.end for child in running], timeout=grace)
    if late:
        for child in running:
            if child.status is None:
                child.process.kill()
        await asyncio.wait(late)
