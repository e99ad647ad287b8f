"""What a node keeps of each cycle, so that one started in its place goes on as if nothing were."""

import json
import struct
from array import array
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, NamedTuple, cast

from fpt_ros.cycle.stage import Stage
from fpt_ros.messages.topics import DEPTH
from fpt_ros.nodes import run_folder
from fpt_ros.nodes.state_file import StateFile
from fpt_ros.parameters import Value

_HEAD = struct.Struct("<qqqQI")

TOLD = 16
"""Latest changes of parameters that are told once more: who listens may not have had them."""


class KeptCycle(NamedTuple):
    """One cycle as it was kept.

    Attributes:
        stamp: of the cycle [ns].
        clock: of the stage.
        done: cycles so far.
        state: of the stage.
        output: the message that was about to be published.
    """

    stamp: int
    clock: tuple[int, int]
    done: int
    state: "array[float]"
    output: bytes


class Kept:
    """The state files of one node; without a run folder nothing is kept.

    A record is written before its message is published: who is killed between the two publishes
    again what was computed, and who is killed before computes the same once more. There are as many
    records as a publisher has history, so that no message is lost that nobody had taken yet.

    Attributes:
        cycles: of the process before this one, oldest first; empty: there was none.
        told: changes of parameters in force, each with the stamp of its cycle: the latest ones.
        pending: changes that are accepted, and not in force yet.
        aside: what else the node wants to know.
    """

    def __init__(
        self, name: str, tell: Callable[[str], object], folder: Path | None = None
    ) -> None:
        """``name`` of the node; ``tell`` is told if nothing can be kept any more.

        ``folder``: by default that of the run.
        """
        folder = folder or run_folder.mine()
        self.cycles: list[KeptCycle] = []
        self.told: list[tuple[int, dict[str, Value]]] = []
        self.pending: dict[str, Value] = {}
        self.aside: dict[str, Any] = {}
        self._older: dict[str, Value] = {}
        self._tell = tell
        self._cycles = self._parameters = None
        if folder is None:
            return
        self._cycles = StateFile(folder / f"{name}.state", DEPTH)
        self._parameters = StateFile(folder / f"{name}.parameters")
        self.cycles = [_cycle(record) for record in self._cycles.records()]
        for record in self._parameters.records()[-1:]:
            self._older, told, self.pending, self.aside = json.loads(record)
            self.told = [(stamp, values) for stamp, values in told]

    def rewind(self, stamp: int) -> dict[str, Value]:
        """Parameters changed in flight before a cycle; what came later is pending again."""
        later = [values for at, values in self.told if at >= stamp]
        self.told = [(at, values) for at, values in self.told if at < stamp]
        in_force = dict(self._older)
        for _, values in self.told:
            in_force |= values
        for values in reversed(later):
            self.pending = {**values, **self.pending}
        return in_force

    def add(self, stamp: int, stage: Stage, done: int, output: bytes) -> None:
        """Keep a cycle."""
        if self._cycles is None:
            return
        state = memoryview(cast("array[float]", stage.state))
        first, latest = stage.clock
        head = _HEAD.pack(stamp, first, latest, done, state.nbytes)
        try:
            self._cycles.add(b"".join((head, state, output)))
        except OSError as error:
            self._give_up(error)

    def accept(self, pending: Mapping[str, Value]) -> None:
        """Keep what waits for the next cycle."""
        self.pending = dict(pending)
        self.save()

    def put_into_force(self, stamp: int, changes: Mapping[str, Value]) -> None:
        """Keep what the cycle with this stamp changes; nothing is pending any more."""
        self.told.append((stamp, dict(changes)))
        for _, values in self.told[:-TOLD]:
            self._older |= values
        self.told, self.pending = self.told[-TOLD:], {}
        self.save()

    def save(self) -> None:
        """Keep the parameters, and what is ``aside``."""
        if self._parameters is None:
            return
        content = (self._older, self.told, self.pending, self.aside)
        try:
            self._parameters.add(json.dumps(content).encode())
        except OSError as error:
            self._give_up(error)

    def _give_up(self, error: OSError) -> None:
        self._cycles = self._parameters = None
        self._tell(f"the state cannot be kept, a killed node ends the run: {error.strerror}")


def _cycle(record: bytes) -> KeptCycle:
    stamp, first, latest, done, length = _HEAD.unpack_from(record)
    end = _HEAD.size + length
    state = array("d", record[_HEAD.size : end])
    return KeptCycle(stamp, (first, latest), done, state, record[end:])
