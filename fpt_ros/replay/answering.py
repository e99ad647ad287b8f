"""A stage that answers its inputs, again and in process.

In real time the recording tells what the stamps do not: a stage acted in the cycles of which it has
an answer; whether a message that it does not wait for had come in time follows from the answer.
"""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from fpt_ros.cycle.matcher import Matcher
from fpt_ros.cycle.stage import Stage
from fpt_ros.errors import BadInput
from fpt_ros.messages.cdr import Codec, MalformedMessage
from fpt_ros.messages.frames import Frame
from fpt_ros.messages.topics import LOOP_TOPICS
from fpt_ros.replay.answer import Due, Lost
from fpt_ros.replay.compared import first_field
from fpt_ros.replay.recorded import Cycle

Frames = list[Frame | None]
Way = Callable[[], Frame]


class Answering:
    """A stage as its node runs it, on what is recorded."""

    def __init__(self, stage: Stage, due: Due, realtime: bool) -> None:
        self.stage: Any = stage
        self._due, self._realtime = due, realtime
        self._matcher = Matcher(stage.inputs, 0, realtime)
        self._codec = Codec(stage.output)
        order = [topic.name for topic in LOOP_TOPICS]
        self._inputs = sorted(
            [(each, at, Codec(each.topic)) for at, each in enumerate(stage.inputs)],
            key=lambda one: order.index(one[0].topic.name),
        )
        self._acted = True

    def __call__(self, cycle: Cycle) -> Frame | None:
        """What it answers; None: it does not act in this cycle."""
        recorded = cycle.messages.get(self.stage.output.name)
        frames = self.complete(cycle)
        if frames is not None:
            return self.first(self.steps(cycle, frames), recorded)
        if recorded is not None:
            raise self.lacks(cycle)
        self._acted = self._realtime
        return None

    def lacks(self, cycle: Cycle) -> Lost:
        """Of a cycle with an answer to nothing."""
        return Lost(f"what {self.stage.name} needs in cycle {cycle.number} is not there")

    def complete(self, cycle: Cycle) -> Frames | None:
        """The frames of the cycle; None: it is not complete, or the stage does not act in it."""
        acts = self.stage.output.name in cycle.messages or not self._realtime
        frames: Frames | None = None
        for each, at, codec in self._inputs:
            data = cycle.messages.get(each.topic.name)
            if data is None or not (acts or each.lag):
                continue
            try:
                frame = self.stage.admit(each.topic, codec.decode(data))
            except (MalformedMessage, BadInput):
                continue  # as the node, which ignores it
            frames = self._matcher.take(at, frame) or frames
        return self._matcher.newest() if self._realtime else frames

    def steps(self, cycle: Cycle, frames: Frames) -> list[Way]:
        """The step, and in real time that without what is not waited for: it may have come late."""
        if not self._acted:
            raise Lost(f"what {self.stage.name} needed before cycle {cycle.number} is not there")
        self._due(cycle.stamp)
        late = [
            None if each.lag or each.optional else frame
            for each, frame in zip(self.stage.inputs, frames, strict=True)
        ]
        seen = [frames, late] if self._realtime and late != frames else [frames]
        return [partial(self.stage.step, *each) for each in seen]

    def first(self, ways: Sequence[Way], recorded: bytes | None) -> Frame:
        """What is recorded, from the first way that gives it; where none does, from the first."""
        if recorded is None or len(ways) == 1:
            return ways[0]()
        was = self._codec.decode(recorded)
        state, clock = self.stage.state[:], self.stage.clock[:]
        for way in (*ways, ways[0]):
            self.stage.state[:], self.stage.clock[:] = state, clock
            answer = way()
            if first_field(self.stage.output, was, answer) is None:
                break
        return answer
