"""What a replayed stage is asked, cycle by cycle, and what may be wrong with it."""

from collections.abc import Sequence
from typing import Protocol

from fpt_ros.cycle.stage import Stage
from fpt_ros.messages.frames import Frame
from fpt_ros.replay.recorded import Cycle
from fpt_ros.runs.changes import Change


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


class Due:
    """Changes in flight, each put into force at its cycle."""

    def __init__(self, stage: Stage, changes: Sequence[Change]) -> None:
        own = [change for change in changes if change.node == stage.name]
        self._waiting = sorted(own, key=lambda change: change.stamp, reverse=True)
        self._stage = stage

    def __call__(self, stamp: int) -> None:
        """Put those into force that are due in the cycle of a stamp [ns]."""
        while self._waiting and self._waiting[-1].stamp <= stamp:
            self._stage.configure(self._waiting.pop().values)
