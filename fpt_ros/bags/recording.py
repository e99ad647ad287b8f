"""Recording a run of the in-process engine: the same file that the recorder makes of the graph."""

from pathlib import Path

from fpt_ros.bags.writer import BagWriter
from fpt_ros.cycle.trajectory_generator import TrajectoryGenerator
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.messages.cdr import Codec
from fpt_ros.messages.topics import DEPTH, LOOP_TOPICS
from fpt_ros.runs.chunks import Chunk, frames
from fpt_ros.runs.run import describe


class EngineRecording(BagWriter):
    """Writes the cycles of an engine to a recording, chunk by chunk.

    A context: the recording is closed at its end, with ``reason`` or with what was raised.

    Args:
        directory: must not exist.
        experiment: that runs.
    """

    def __init__(self, directory: Path, experiment: Experiment) -> None:
        self._sharing = bool(experiment.nodes[TrajectoryGenerator.name]["time_sharing"])
        self._codecs = {topic.name: Codec(topic) for topic in LOOP_TOPICS}
        info = describe(experiment, "in_process", "")
        del info["complete"], info["reason"]
        super().__init__(directory, experiment.nodes, {**info, "clock": "lockstep"})

    def take(self, chunk: Chunk) -> None:
        """Write the messages of the next cycles, in the order of events."""
        for topic, frame in frames(chunk, self._sharing):
            name = f"/{topic.name}"
            self.add_topic(name, topic.type, DEPTH)
            data = self._codecs[topic.name].encode(frame)
            self.write(name, topic.type, frame.stamp, data)
