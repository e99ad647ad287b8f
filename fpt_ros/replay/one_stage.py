"""One node of a recorded run again: its stage, in process, on the inputs that it had.

In lockstep the stamps say what a node has seen. In real time the recording tells the rest: what a
node said tells what it had heard by then.
"""

from collections.abc import Iterator
from typing import NamedTuple

from fpt_ros.cycle.fpt_deformer import FptDeformer
from fpt_ros.cycle.plant_simulator import PlantSimulator
from fpt_ros.cycle.stage import Stage
from fpt_ros.errors import Diverged
from fpt_ros.messages.cdr import MalformedMessage
from fpt_ros.messages.frames import Frame
from fpt_ros.replay.answer import Answer, Due, Lost
from fpt_ros.replay.answering import Answering
from fpt_ros.replay.deformer import Deformer
from fpt_ros.replay.plant import Plant
from fpt_ros.replay.recorded import Cycle, Recorded


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


def answers(recorded: Recorded, stage: Stage) -> Iterator[Answered]:
    """Cycle by cycle, as far as the recording goes; ``stage``: fresh, takes part in the run."""
    answer = _answer(stage, Due(stage, recorded.changes), recorded.realtime)
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


def _answer(stage: Stage, due: Due, realtime: bool) -> Answer:
    if isinstance(stage, PlantSimulator):
        return Plant(stage, due, realtime)
    alone = realtime and isinstance(stage, FptDeformer)
    return Deformer(stage, due, realtime) if alone else Answering(stage, due, realtime)
