"""Recording a run of the in-process engine: the same file that the recorder makes of the graph."""

from pathlib import Path
from types import TracebackType
from typing import Self

from fpt_ros.bags.writer import BagWriter
from fpt_ros.engine.engine import Engine
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.messages.cdr import Codec
from fpt_ros.messages.frames import Frame
from fpt_ros.messages.topics import DEPTH, LOOP_TOPICS, Topic
from fpt_ros.runs.run import describe


class EngineRecording:
    """Writes the cycles of an engine to a recording, as they become complete.

    A context: the recording is closed at its end, with ``reason`` or with what was raised.
    Without a directory it does nothing.
    """

    def __init__(self, directory: Path | None, experiment: Experiment, engine: Engine) -> None:
        self.reason = ""
        self._engine = engine
        self._written = 0
        self._writer: BagWriter | None = None
        self._codecs = {topic.name: Codec(topic) for topic in LOOP_TOPICS}
        if directory is not None:
            info = describe(experiment, "in_process", "")
            del info["complete"], info["reason"]
            self._writer = BagWriter(directory, experiment.nodes, {**info, "clock": "lockstep"})

    def update(self) -> None:
        """Write what has been done since the last time."""
        if self._writer is not None:
            self._engine.frames(self._written, self._record)
            self._written = self._engine.done

    def _record(self, topic: Topic, frame: Frame) -> None:
        assert self._writer is not None
        name = f"/{topic.name}"
        self._writer.add_topic(name, topic.type, DEPTH)
        data = self._codecs[topic.name].encode(frame)
        self._writer.write(name, topic.type, frame.stamp, data)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._writer is None:
            return
        if error is not None:
            self._writer.__exit__(kind, error, trace)
        else:
            self.update()
            self._writer.close(self.reason)
