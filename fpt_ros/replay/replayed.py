"""Replaying a node and comparing what it answers: what ``fpt replay`` does."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol, Self

from fpt_ros.cycle.stage import Stage
from fpt_ros.cycle.stages import STAGES
from fpt_ros.errors import BadInput
from fpt_ros.messages.frames import Frame
from fpt_ros.messages.topics import Topic
from fpt_ros.replay.compared import Comparison, Difference
from fpt_ros.replay.one_stage import answers
from fpt_ros.replay.recorded import Cycle, Recorded

Progress = Callable[[int], None]


class Out(Protocol):
    """Takes a replay as it goes on."""

    def add(self, cycle: Cycle, topic: Topic, answer: Frame | None) -> None:
        """A recorded cycle, with the node's answer on its topic."""
        ...


@dataclass(frozen=True)
class Outcome:
    """What came of running a recording, or one node of it, again.

    Attributes:
        cycles: that were compared.
        differing: messages.
        first: difference; None: what was compared is equal to the last bit.
        notes: what its reader should know: where it ended, and why.
    """

    cycles: int
    differing: int
    first: Difference | None
    notes: tuple[str, ...] = ()

    @property
    def equal(self) -> bool:
        """Nothing that was compared differs."""
        return self.first is None

    @classmethod
    def of(cls, comparison: Comparison, *notes: str) -> Self:
        """Of a comparison that is done; empty notes are left out."""
        told = tuple(note for note in notes if note)
        return cls(comparison.cycles, comparison.differing, comparison.first, told)


class Replay:
    """One node of a recorded run, to be run again.

    Attributes:
        recorded: the run.
        stage: the node's, fresh.
    """

    def __init__(self, recorded: Recorded, node: str) -> None:
        """Make the stage of the recorded parameters.

        Raises:
            BadInput: there is no such node in the recording.
        """
        if node not in STAGES:
            raise BadInput(f"there is no node '{node}' to replay: there are {', '.join(STAGES)}")
        if node not in recorded.nodes:
            there = ", ".join(recorded.nodes) or "none"
            raise BadInput(f"{recorded.path} holds nothing of the node {node}: it has {there}")
        self.recorded = recorded
        self.stage: Stage = STAGES[node](recorded.parameters[node])

    def run(self, progress: Progress = lambda done: None, out: Out | None = None) -> Outcome:
        """All cycles, in process.

        Args:
            progress: is told the number of each.
            out: takes the run with the node's new answers in the place of the recorded ones.
        """
        recorded, topic = self.recorded, self.stage.output
        comparison, end = Comparison(recorded.prefix), ""
        for cycle, frame, end, diverged in answers(recorded, self.stage):
            was = cycle.messages.get(topic.name)
            new = frame is not None and (was is not None or recorded.complete)
            if new or (diverged and was is not None):
                comparison.add(topic, cycle.number, was, frame)
            progress(cycle.number + 1)
            if out is not None and not end:
                out.add(cycle, topic, frame)
        return Outcome.of(comparison, *recorded.missing, end, self._late(comparison))

    def _late(self, comparison: Comparison) -> str:
        """In real time nobody tells whether the recorder was there from the beginning."""
        first = comparison.first
        if not self.recorded.realtime or first is None or first.cycle != comparison.begin:
            return ""
        return (
            f"{self.stage.name}: the first answer differs already: the recording may begin after "
            "the node did, which remembers what was before"
        )
