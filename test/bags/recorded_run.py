"""An engine run together with its recording."""

from pathlib import Path

from consumed import Consumed

from fpt_ros.bags.recording import EngineRecording
from fpt_ros.engine.engine import Engine
from fpt_ros.experiments import experiment
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.messages.frames import Frame
from fpt_ros.messages.topics import Topic
from fpt_ros.parameters import Value
from fpt_ros.runs.chunks import frames
from fpt_ros.runs.run import Series

INFO = {
    "experiment": "tora",
    "variant": "adaptive",
    "engine": "in_process",
    "version": "0.1.0",
    "clock": "lockstep",
}


class Recorded:
    """A run as it was shown, and where it was recorded."""

    # no dataclass: hypothesis would print all of it when a test fails
    def __init__(
        self,
        experiment: Experiment,
        frames: list[tuple[Topic, Frame]],
        topics: dict[str, Series],
        directory: Path,
    ) -> None:
        self.experiment = experiment
        self.frames = frames
        self.topics = topics
        self.directory = directory

    @property
    def file(self) -> Path:
        return self.directory / f"{self.directory.name}_0.mcap"

    @property
    def parameters(self) -> dict[str, dict[str, Value]]:
        """As files hold them: without empty lists, which have no type in ROS."""
        return {
            node: {name: value for name, value in values.items() if value != []}
            for node, values in self.experiment.nodes.items()
        }

    def of(self, topic: Topic) -> list[Frame]:
        return [frame for shown, frame in self.frames if shown is topic]


def record(directory: Path) -> Recorded:
    tora = experiment.load("tora", duration=1.0)
    loop = tora.loop()
    whole = Consumed()
    with EngineRecording(directory, tora) as recording:
        Engine(loop, consumers=(whole, recording)).run()
    topics = whole.topics()
    return Recorded(tora, list(frames(topics)), topics, directory)
