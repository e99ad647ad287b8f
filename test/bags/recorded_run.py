"""An engine run together with its recording."""

from pathlib import Path

from fpt_ros.bags.writer import BagWriter
from fpt_ros.loop import engine, experiment
from fpt_ros.loop.experiment import Experiment
from fpt_ros.loop.run import Collector
from fpt_ros.messages.cdr import Codec
from fpt_ros.messages.frames import Frame
from fpt_ros.messages.topics import LOOP_TOPICS, Topic

INFO = {"experiment": "tora", "variant": "adaptive", "engine": "in_process", "version": "0.1.0"}


class Recorded:
    """A run as it was shown, and where it was recorded."""

    # no dataclass: hypothesis would print all of it when a test fails
    def __init__(
        self,
        experiment: Experiment,
        frames: list[tuple[Topic, Frame]],
        collector: Collector,
        directory: Path,
    ) -> None:
        self.experiment = experiment
        self.frames = frames
        self.collector = collector
        self.directory = directory

    @property
    def file(self) -> Path:
        return self.directory / f"{self.directory.name}_0.mcap"

    def of(self, topic: Topic) -> list[Frame]:
        return [frame for shown, frame in self.frames if shown is topic]


def record(directory: Path) -> Recorded:
    tora = experiment.load("tora", duration=1.0)
    frames: list[tuple[Topic, Frame]] = []
    collector = Collector()
    codecs = {topic.name: Codec(topic) for topic in LOOP_TOPICS}

    with BagWriter(directory, tora.nodes, INFO) as bag:

        def observe(topic: Topic, frame: Frame) -> None:
            frames.append((topic, frame))
            collector(topic, frame)
            data = codecs[topic.name].encode(frame)
            bag.write(f"/{topic.name}", topic.type, frame.stamp, data)

        engine.run(tora.loop(), observe)
    return Recorded(tora, frames, collector, directory)
