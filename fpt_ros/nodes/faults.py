"""What may happen to a running graph, and making it happen."""

import os
import random
import signal
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from fpt_ros.errors import BadInput, RunFailed
from fpt_ros.experiments.description import NODE as RECORDER
from fpt_ros.nodes import asking
from fpt_ros.nodes.intruder import Intruder

LONGEST_STOP = 5.0
"""Seconds."""

FLOOD = 2000


def _parent(process: int) -> int:
    """Of a process: of a node the nurse, of that ``fpt run``."""
    stat = Path(f"/proc/{process}/stat").read_text()
    return int(stat.rpartition(")")[2].split()[1])


class Victim:
    """A graph that ``fpt run`` runs, as its faults see it."""

    def __init__(self, process: int, somebody: Intruder, chance: random.Random) -> None:
        """``process``: that of ``fpt run``."""
        self._process, self._somebody, self._chance = process, somebody, chance

    def nodes(self) -> dict[str, int]:
        """The nodes that run, and their processes."""
        found: dict[str, int] = {}
        for folder in Path("/proc").glob("[0-9]*"):
            with suppress(OSError, ValueError, IndexError):
                title, process = (folder / "cmdline").read_text().split()[0], int(folder.name)
                if _parent(_parent(process)) == self._process:
                    found[title] = process
        return found

    def doing(self) -> list[str]:
        """What the threads of each node wait for in the kernel: where one hangs, it is told."""
        told = []
        for name, process in sorted(self.nodes().items()):
            threads = []
            for thread in Path(f"/proc/{process}/task").glob("*"):
                with suppress(OSError):
                    state = (thread / "stat").read_text().rpartition(")")[2].split()[0]
                    where = (thread / "wchan").read_text() or "running"
                    threads.append(f"{(thread / 'comm').read_text().strip()} {state} {where}")
            told.append(f"{name}: {'; '.join(threads)}")
        return told

    def kill(self, count: int = 1) -> str:
        """Kill -9 of some nodes at once; which ones."""
        nodes = self.nodes()
        chosen = self._chance.sample(sorted(nodes), min(count, len(nodes)))
        for name in chosen:
            _signal(nodes[name], signal.SIGKILL)
        return ", ".join(chosen)

    def kill_two(self) -> str:
        """Two nodes at once."""
        return self.kill(2)

    def kill_recorder(self) -> str:
        """The recorder."""
        _signal(self.nodes().get(RECORDER, 0), signal.SIGKILL)
        return RECORDER

    def stop(self) -> str:
        """SIGSTOP of a node, for a while."""
        nodes = self.nodes()
        if not nodes:
            return ""
        name = self._chance.choice(sorted(nodes))
        seconds = LONGEST_STOP * self._chance.random() ** 2
        _signal(nodes[name], signal.SIGSTOP)
        self._somebody.listen(seconds)
        _signal(nodes[name], signal.SIGCONT)
        return f"{name} for {seconds:.1f} s"

    def wild(self) -> str:
        """Foreign messages of all kinds on all topics."""
        self._somebody.say_everything(self._chance.randrange(1000))
        return ""

    def flood(self) -> str:
        """Foreign messages, as fast as it goes."""
        self._somebody.flood(FLOOD)
        return ""

    def slow(self) -> str:
        """A subscriber of everything that takes nothing."""
        self._somebody.subscribe_and_never_take()
        return ""

    def accepted(self) -> str:
        """A parameter that is changed in flight."""
        decay = round(self._chance.uniform(5.0, 7.0), 3)
        with asking.graph() as graph:
            graph.set("trajectory_generator", {"lambda": decay})
        return f"lambda = {decay}"

    def refused(self) -> str:
        """A parameter that is not valid.

        Raises:
            RunFailed: it was accepted.
        """
        with asking.graph() as graph:
            try:
                graph.set("trajectory_generator", {"lambda": -1.0})
            except BadInput:
                return ""
        raise RunFailed("trajectory_generator.lambda = -1 was accepted")


FAULTS: dict[str, Callable[[Victim], str]] = {
    "kill -9 of a node": Victim.kill,
    "kill -9 of two at once": Victim.kill_two,
    "kill -9 of the recorder": Victim.kill_recorder,
    "SIGSTOP, up to 5 s": Victim.stop,
    "wild foreign messages": Victim.wild,
    "flood of foreign messages": Victim.flood,
    "subscriber that takes nothing": Victim.slow,
    "parameter accepted": Victim.accepted,
    "parameter refused": Victim.refused,
}
"""By what they are called."""


def _signal(process: int, number: int) -> None:
    if process:
        with suppress(ProcessLookupError):  # it has just ended
            os.kill(process, number)
