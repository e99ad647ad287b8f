"""A process of the graph: how it is started, what it says last, and how it ends."""

import asyncio
import os
import signal
import tempfile
from collections import deque
from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path

from fpt_ros.errors import BadInput, FptError, RunFailed

GRACE = 1.2
"""Seconds that a process has to end when asked to, before it is killed."""

LAST_LINES = 12


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
