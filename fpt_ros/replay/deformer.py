"""The deformer of a recorded run in real time again: it also commands by itself.

Where the loop is silent, or in a stop, it holds the position by the measurement alone, or commands
the safe effort. What it did follows from what it said.
"""

from functools import partial

from fpt_ros.cycle.holding import with_velocity
from fpt_ros.cycle.stage import Stage
from fpt_ros.errors import BadInput
from fpt_ros.messages.cdr import Codec, MalformedMessage
from fpt_ros.messages.frames import Frame, JointStates
from fpt_ros.messages.topics import COMMAND, JOINT_STATES
from fpt_ros.replay.answer import Due
from fpt_ros.replay.answering import Answering, Way
from fpt_ros.replay.compared import first_field
from fpt_ros.replay.recorded import Cycle


class Deformer(Answering):
    """The deformer as its node runs it."""

    def __init__(self, stage: Stage, due: Due, realtime: bool) -> None:
        super().__init__(stage, due, realtime)
        self._measured: JointStates | None = None
        self._states = Codec(JOINT_STATES)

    def __call__(self, cycle: Cycle) -> Frame | None:
        """What it says in a cycle; None: nothing."""
        self._hear(cycle)
        frames, recorded = self.complete(cycle), cycle.messages.get(COMMAND.name)
        if recorded is None:
            return None
        steps = self.steps(cycle, frames) if frames is not None else []
        answer = self.first([*steps, *self._alone(cycle)], recorded)
        if not steps and first_field(COMMAND, self._codec.decode(recorded), answer) is not None:
            raise self.lacks(cycle)
        return answer

    def _hear(self, cycle: Cycle) -> None:
        """The measurement, where a position may have to be held by that alone."""
        data = cycle.messages.get(JOINT_STATES.name)
        if data is not None and self.stage.limits.hold.holds:
            try:
                frame = self.stage.admit(JOINT_STATES, self._states.decode(data))
            except (MalformedMessage, BadInput):
                return  # as the node, which ignores it
            self._measured = with_velocity(frame, self._measured)

    def _alone(self, cycle: Cycle) -> list[Way]:
        """What it may say without the others."""
        ways: list[Way] = [partial(self.stage.safe_command, cycle.stamp)]
        if self._measured is not None:
            ways.append(partial(self.stage.hold_command, self._measured, cycle.stamp))
        return ways
