"""The plant of a recorded run again, in process.

In real time the effort that it shows in the next cycle says which command acted.
"""

from fpt_ros.cycle.plant_simulator import PlantSimulator
from fpt_ros.messages.cdr import Codec
from fpt_ros.messages.frames import Command, Frame, JointStates
from fpt_ros.messages.topics import COMMAND, JOINT_STATES
from fpt_ros.replay.answer import Due, Lost
from fpt_ros.replay.recorded import Cycle


class Plant:
    """The plant: it shows its state, and the command of the cycle takes it to the next one."""

    def __init__(self, plant: PlantSimulator, due: Due, realtime: bool) -> None:
        self._plant, self._due, self._realtime = plant, due, realtime
        self._codec, self._own = Codec(COMMAND), Codec(JOINT_STATES)
        self._before: Cycle | None = None
        self._origin = 0
        self._commands: list[Command] = []
        self._remembered = plant.timeout // plant.cycle_time + 2

    def __call__(self, cycle: Cycle) -> Frame | None:
        """What it measures in a cycle; None: no cycle of the plant has this stamp."""
        if self._before is None:
            self._origin = cycle.stamp
        elif (cycle.stamp - self._origin) % self._plant.cycle_time:
            return None  # of a node by itself, between two cycles
        else:
            if cycle.number != self._before.number + 1:
                raise Lost(f"cycle {self._before.number + 1} is not in the recording")
            command = self._command(self._before, cycle)
            self._due(self._before.stamp)
            self._plant.advance(command, self._before.stamp - self._origin)
        self._before = cycle
        return self._plant.measure(cycle.stamp, cycle.number)

    def _command(self, before: Cycle, cycle: Cycle) -> Command:
        """That which acted in the cycle before this one."""
        data = before.messages.get(COMMAND.name)
        if data is not None:
            command = self._codec.decode(data)
            assert isinstance(command, Command)
            self._commands = [*self._commands[-self._remembered :], command]
        elif not self._realtime:
            raise Lost(f"the command of cycle {before.number} is not in the recording")
        candidates = [*reversed(self._commands), self._plant.safe_command(before.stamp)]
        shown = cycle.messages.get(JOINT_STATES.name)
        if self._realtime and shown is not None:
            told = self._own.decode(shown)
            assert isinstance(told, JointStates)
            for candidate in candidates:
                if list(candidate.effort) == list(told.effort):
                    return candidate
        return candidates[0]
