"""A whole recorded experiment run again from the recording alone: what ``fpt rerun`` does.

In lockstep the engine runs it: the same parameters, seed and changes in flight give the same bits.
In real time that cannot be, because what acted depends on the clock; there every node is replayed
on what it had seen.
"""

from collections import defaultdict
from collections.abc import Iterator

from fpt_ros.cycle.stages import STAGES
from fpt_ros.cycle.trajectory_generator import TrajectoryGenerator
from fpt_ros.engine.engine import Engine
from fpt_ros.errors import Diverged
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.messages.frames import Frame
from fpt_ros.messages.topics import LOOP_TOPICS, Topic
from fpt_ros.parameters import Value
from fpt_ros.replay.compared import Comparison
from fpt_ros.replay.recorded import Cycle, Recorded
from fpt_ros.replay.replayed import Outcome, Progress, Replay
from fpt_ros.runs.chunks import Chunk, frames


def rerun(recorded: Recorded, progress: Progress = lambda done: None) -> dict[str, Outcome]:
    """Run it again and compare, as far as the recording goes.

    Returns:
        By what was run: ``loop``; of a recording in real time, or one that does not hold the
        parameters of the whole loop, each node that it holds.

    Raises:
        BadInput: its parameters are not those of a run, or it does not begin with one.
    """
    if recorded.realtime or not STAGES.keys() <= recorded.parameters.keys():
        return {node: Replay(recorded, node).run(progress) for node in recorded.nodes}
    return {"loop": _loop(recorded, progress)}


def _loop(recorded: Recorded, progress: Progress) -> Outcome:
    info = recorded.info
    nodes = {name: dict(values) for name, values in recorded.parameters.items()}
    experiment = Experiment(info.get("experiment", ""), info.get("variant", ""), nodes)
    against = _Against(recorded, bool(nodes[TrajectoryGenerator.name].get("time_sharing")))
    engine = Engine(experiment.loop(), consumers=[against], changes=_changes(recorded))
    end = ""
    try:
        engine.run(progress, recorded.total)
    except Diverged as error:
        end = f"the run now {error}"
    against.finish()
    return Outcome.of(against.comparison, *recorded.missing, end)


def _changes(recorded: Recorded) -> dict[int, dict[str, dict[str, Value]]]:
    """By cycle and node."""
    found: dict[int, dict[str, dict[str, Value]]] = defaultdict(lambda: defaultdict(dict))
    for change in recorded.changes:
        found[change.stamp // recorded.cycle_time][change.node].update(change.values)
    return found


class _Against:
    """Takes what the engine gives, and compares it with the recorded cycles.

    Attributes:
        comparison: of all messages so far.
    """

    def __init__(self, recorded: Recorded, sharing: bool) -> None:
        """``sharing``: coordinates take turns."""
        self.comparison = Comparison(recorded.prefix)
        self._sharing, self._complete = sharing, recorded.complete
        self._cycles: Iterator[Cycle] = recorded.cycles()
        self._cycle: Cycle | None = next(self._cycles, None)

    def take(self, chunk: Chunk) -> None:
        """The next cycles of the engine."""
        for topic, frame in frames(chunk, self._sharing):
            while self._cycle is not None and self._cycle.stamp < frame.stamp:
                self._next()
            if self._cycle is not None and self._cycle.stamp == frame.stamp:
                self._compare(self._cycle, topic, frame)

    def _compare(self, cycle: Cycle, topic: Topic, frame: Frame) -> None:
        was = cycle.messages.pop(topic.name, None)
        if was is not None or self._complete:
            self.comparison.add(topic, cycle.number, was, frame)

    def _next(self) -> None:
        """On to the next recorded cycle; what is left of this one is not there any more."""
        assert self._cycle is not None
        number, left = self._cycle.number, self._cycle.messages
        for topic in LOOP_TOPICS:
            if topic.name in left:
                self.comparison.add(topic, number, left[topic.name], None)
        self._cycle = next(self._cycles, None)

    def finish(self) -> None:
        """The engine has ended: the recording should have, too."""
        while self._cycle is not None:
            self._next()
