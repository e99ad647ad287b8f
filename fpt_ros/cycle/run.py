"""The loop stage by stage: who needs what is said by ``Stage.inputs``, and nowhere else."""

from collections.abc import Iterator, Mapping
from typing import Any

from fpt_ros.cycle.stage import Stage
from fpt_ros.cycle.stages import Loop
from fpt_ros.messages.frames import Command, Frame
from fpt_ros.messages.topics import COMMAND, JOINT_STATES, Topic
from fpt_ros.parameters import Values

Changes = Mapping[int, Mapping[str, Values]]
"""Parameters that change in flight: by cycle, the live ones of each node."""

NO_CHANGES: Changes = {}


class Run:
    """Runs a loop cycle by cycle, each stage as its node runs it: plain Python, frames in and out.

    A change of parameters takes effect where the stage acts on the cycle; of the plant, where the
    force acts on it, behind the measurement.

    Attributes:
        cycle: the next one.
    """

    def __init__(
        self,
        loop: Loop,
        cycle: int = 0,
        command: Command | None = None,
        changes: Changes = NO_CHANGES,
    ) -> None:
        """Begin with a cycle; of a later one than 0 ``command`` is that of the cycle before.

        The stages' memories have to be those of the start of that cycle.
        """
        self._loop = loop
        self._changes = changes
        self.cycle = cycle
        self._before: dict[str, Frame | None] = {COMMAND.name: command}
        stamp = cycle * loop.plant.cycle_time
        for stage in loop.answering():
            if cycle:
                stage.clock[0], stage.clock[1] = 0, stamp - loop.plant.cycle_time
            else:
                stage.clock[0] = stage.clock[1] = -1

    def frames(self, cycles: int | None = None) -> Iterator[tuple[Topic, Frame]]:
        """The frames of the next cycles, to the end of the run by default, in the order of events.

        Raises:
            Diverged: a stage could not go on.
        """
        plant = self._loop.plant
        end = plant.cycles if cycles is None else self.cycle + cycles
        while self.cycle < end:
            stamp = self.cycle * plant.cycle_time
            now: dict[str, Frame | None] = {}
            measured = plant.measure(stamp, self.cycle)
            now[JOINT_STATES.name] = measured
            yield JOINT_STATES, measured
            for stage in self._loop.answering():
                if not stage.inputs:
                    continue
                self._configure(stage)
                step: Any = stage.step
                frame = step(
                    *[(self._before if each.lag else now)[each.topic.name] for each in stage.inputs]
                )
                now[stage.output.name] = frame
                yield stage.output, frame
            command = now[COMMAND.name]
            assert isinstance(command, Command)
            self._configure(plant)
            plant.advance(command, stamp)
            self._before = now
            self.cycle += 1

    def _configure(self, stage: Stage) -> None:
        """Put into force what changes in this cycle."""
        values = self._changes.get(self.cycle, {}).get(stage.name)
        if values:
            stage.configure(values)
