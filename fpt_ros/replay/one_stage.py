"""One node of a recorded run again: its stage, in process, on the inputs that it had.

In lockstep the stamps say what a node has seen. In real time the recording tells the rest: a stage
acted in the cycles of which it has an answer; whether a message that it does not wait for had come
in time, and which command acted on the plant, follows from what was answered.
"""

from collections.abc import Iterator, Sequence
from typing import Any, NamedTuple, Protocol

from fpt_ros.cycle.fpt_deformer import FptDeformer
from fpt_ros.cycle.matcher import Matcher
from fpt_ros.cycle.plant_simulator import PlantSimulator
from fpt_ros.cycle.stage import Stage
from fpt_ros.errors import BadInput, Diverged
from fpt_ros.messages.cdr import Codec, MalformedMessage
from fpt_ros.messages.frames import Command, Frame, JointStates
from fpt_ros.messages.topics import COMMAND, JOINT_STATES, LOOP_TOPICS
from fpt_ros.replay.compared import first_field
from fpt_ros.replay.recorded import Cycle, Recorded
from fpt_ros.runs.changes import Change


class Answered(NamedTuple):
    """A recorded cycle, and what the stage publishes in it.

    Attributes:
        cycle: as it is recorded.
        frame: None: the stage does not act, or has ended.
        end: why the replay goes no further, empty where it does.
        diverged: that is because the stage could not go on.
    """

    cycle: Cycle
    frame: Frame | None
    end: str = ""
    diverged: bool = False


class Answer(Protocol):
    """A stage as its node runs it."""

    def __call__(self, cycle: Cycle) -> Frame | None:
        """What it publishes in the next cycle; None: it does not act.

        Raises:
            Lost: what it needs is not in the recording.
            Diverged: it could not go on.
        """


class Lost(Exception):
    """A cycle without which the next ones cannot be replayed is not in the recording."""


def answers(recorded: Recorded, stage: Stage) -> Iterator[Answered]:
    """Cycle by cycle, as far as the recording goes; ``stage``: fresh, takes part in the run."""
    make: Any = _Plant if isinstance(stage, PlantSimulator) else _Answering
    answer: Answer = make(stage, _Due(stage, recorded.changes), recorded.realtime)
    for due, cycle in enumerate(recorded.cycles()):
        if not recorded.realtime and cycle.number != due:
            yield Answered(cycle, None, f"cycle {due} is not in the recording")
            return
        try:
            frame = answer(cycle)
        except (Lost, Diverged, MalformedMessage) as error:
            yield Answered(cycle, None, str(error), isinstance(error, Diverged))
            return
        yield Answered(cycle, frame)


class _Due:
    """Changes in flight, each put into force at its cycle."""

    def __init__(self, stage: Stage, changes: Sequence[Change]) -> None:
        own = [change for change in changes if change.node == stage.name]
        self._waiting = sorted(own, key=lambda change: change.stamp, reverse=True)
        self._stage = stage

    def __call__(self, stamp: int) -> None:
        while self._waiting and self._waiting[-1].stamp <= stamp:
            self._stage.configure(self._waiting.pop().values)


class _Answering:
    """A stage that answers its inputs."""

    def __init__(self, stage: Stage, due: _Due, realtime: bool) -> None:
        self._stage: Any = stage
        self._due, self._realtime = due, realtime
        self._matcher = Matcher(stage.inputs, 0, realtime)
        self._output, self._codec = stage.output, Codec(stage.output)
        order = [topic.name for topic in LOOP_TOPICS]
        self._inputs = sorted(
            [(each, at, Codec(each.topic)) for at, each in enumerate(stage.inputs)],
            key=lambda one: order.index(one[0].topic.name),
        )
        self._acted = True

    def __call__(self, cycle: Cycle) -> Frame | None:
        recorded = cycle.messages.get(self._output.name)
        acts = recorded is not None or not self._realtime
        frames: list[Frame | None] | None = None
        for each, at, codec in self._inputs:
            data = cycle.messages.get(each.topic.name)
            if data is None or not (acts or each.lag):
                continue
            try:
                frame = self._stage.admit(each.topic, codec.decode(data))
            except (MalformedMessage, BadInput):
                continue  # as the node, which ignores it
            frames = self._matcher.take(at, frame) or frames
        if self._realtime:
            frames = self._matcher.newest()
        if frames is None:
            if recorded is not None:
                return self._unasked(cycle, recorded)
            self._acted = self._realtime
            return None
        if not self._acted:
            raise Lost(f"what {self._stage.name} needed before cycle {cycle.number} is not there")
        self._due(cycle.stamp)
        return self._step(frames, recorded)

    def _unasked(self, cycle: Cycle, recorded: bytes) -> Frame:
        """In real time: the deformer commands the safe effort where nothing is measured."""
        if self._realtime and isinstance(self._stage, FptDeformer):
            safe = self._stage.safe_command(cycle.stamp)
            if first_field(self._output, self._codec.decode(recorded), safe) is None:
                return safe
        raise Lost(f"what {self._stage.name} needs in cycle {cycle.number} is not there")

    def _step(self, frames: list[Frame | None], recorded: bytes | None) -> Frame:
        """One step; in real time what is not waited for may have come too late."""
        late = [
            None if each.lag or each.optional else frame
            for each, frame in zip(self._stage.inputs, frames, strict=True)
        ]
        if recorded is None or late == frames or not self._realtime:
            answer: Frame = self._stage.step(*frames)
            return answer
        was = self._codec.decode(recorded)
        state, clock = self._stage.state[:], self._stage.clock[:]
        for seen in (frames, late, frames):
            self._stage.state[:], self._stage.clock[:] = state, clock
            answer = self._stage.step(*seen)
            if first_field(self._output, was, answer) is None:
                break
        return answer


class _Plant:
    """The plant: it shows its state, and the command of the cycle takes it to the next one."""

    def __init__(self, plant: PlantSimulator, due: _Due, realtime: bool) -> None:
        self._plant, self._due, self._realtime = plant, due, realtime
        self._codec, self._own = Codec(COMMAND), Codec(JOINT_STATES)
        self._before: Cycle | None = None
        self._origin = 0
        self._commands: list[Command] = []
        self._remembered = plant.timeout // plant.cycle_time + 2

    def __call__(self, cycle: Cycle) -> Frame | None:
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
