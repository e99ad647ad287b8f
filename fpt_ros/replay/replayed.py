"""Replaying a node and comparing what it answers: what ``fpt replay`` does."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Protocol, Self

from fpt_ros.cycle.stage import Stage
from fpt_ros.cycle.stages import STAGES
from fpt_ros.errors import BadInput
from fpt_ros.messages.frames import Frame
from fpt_ros.messages.topics import Topic
from fpt_ros.parameters import Value, Values
from fpt_ros.replay.compared import Comparison, Difference
from fpt_ros.replay.one_stage import answers, with_settings
from fpt_ros.replay.recorded import Cycle, Recorded
from fpt_ros.runs.changes import Change

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
        changes: of its parameters in flight.
    """

    def __init__(self, recorded: Recorded, node: str, settings: Values | None = None) -> None:
        """``settings``: parameters that differ from the recorded ones, from the start to the end.

        Raises:
            BadInput: there is no such node in the recording, or a setting is not valid.
        """
        self.recorded, self.node = recorded, node
        settings = settings or {}
        if node not in STAGES:
            raise BadInput(f"there is no node '{node}' to replay: there are {', '.join(STAGES)}")
        if node not in recorded.nodes:
            there = ", ".join(recorded.nodes) or "none"
            raise BadInput(f"{recorded.path} holds nothing of the node {node}: it has {there}")
        self.parameters: dict[str, dict[str, Value]] = {
            **recorded.parameters,
            node: with_settings(recorded, node, settings),
        }
        self.stage: Stage = STAGES[node](self.parameters[node])
        self.changes = tuple(
            Change(node, change.stamp, kept)
            for change in recorded.changes
            if change.node == node and (kept := _without(change.values, settings))
        )

    def run(self, progress: Progress = lambda done: None, out: Out | None = None) -> Outcome:
        """All cycles, in process.

        Args:
            progress: is told the number of each.
            out: takes the run with the node's new answers in the place of the recorded ones.
        """
        recorded, topic = self.recorded, self.stage.output
        comparison, end = Comparison(recorded.prefix), ""
        for cycle, frame, end, diverged in answers(recorded, self.stage, self.changes):
            was = cycle.messages.get(topic.name)
            new = frame is not None and (was is not None or recorded.complete)
            if new or (diverged and was is not None):
                comparison.add(topic, cycle.number, was, frame)
            progress(cycle.number + 1)
            if out is not None and not end:
                out.add(cycle, topic, frame)
        return Outcome.of(comparison, *recorded.missing, end)


def _without(values: Mapping[str, Value], settings: Values) -> dict[str, Value]:
    """A change without the parameters that are set to the end."""
    return {name: value for name, value in values.items() if name not in settings}
