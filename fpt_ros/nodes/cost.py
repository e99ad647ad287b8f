"""What the process of a node takes of the machine, for /diagnostics."""

import os
import socket
from pathlib import Path
from time import monotonic, process_time

from fpt_ros.runs.cost import MEMORY, PROCESS, PROCESSOR

_PAGE = os.sysconf("SC_PAGE_SIZE")


class Cost:
    """Processor and memory of this process; nodes of one process share them."""

    def __init__(self) -> None:
        self._since = monotonic(), process_time()
        self._process = f"{os.getpid()}@{socket.gethostname()}"

    def values(self) -> dict[str, str]:
        """Share of one core since the last call, and the memory that is resident now."""
        (wall, cpu), now = self._since, (monotonic(), process_time())
        self._since = now
        share = (now[1] - cpu) / max(now[0] - wall, 1e-3)
        resident = int(Path("/proc/self/statm").read_text().split()[1]) * _PAGE
        return {
            PROCESS: self._process,
            PROCESSOR: f"{100 * share:.1f}",
            MEMORY: f"{resident / 1e6:.1f}",
        }
