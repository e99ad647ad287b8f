"""The recording of a replay: the run with new answers of one node in the place of the old ones."""

from collections import deque
from pathlib import Path

from fpt_ros.bags import changes
from fpt_ros.bags.writer import BagWriter
from fpt_ros.messages.cdr import Codec
from fpt_ros.messages.frames import Frame
from fpt_ros.messages.topics import DEPTH, LOOP_TOPICS, Topic
from fpt_ros.replay.recorded import Cycle
from fpt_ros.replay.replayed import Replay


class ReplayWriter(BagWriter):
    """Writes it, cycle by cycle, as a recording that every command reads. A context."""

    def __init__(self, directory: Path, replay: Replay) -> None:
        """Create the directory.

        Raises:
            BadInput: it exists or cannot be created.
        """
        recorded = replay.recorded
        ended = ("complete", "reason", "missing")
        info = {key: value for key, value in recorded.info.items() if key not in ended}
        info["replayed"] = replay.stage.name
        super().__init__(directory, recorded.parameters, info)
        self._prefix, self.reason = recorded.prefix, recorded.info["reason"]
        self._changes = deque(sorted(recorded.changes, key=lambda change: change.stamp))
        self._codecs = {topic.name: Codec(topic) for topic in LOOP_TOPICS}

    def add(self, cycle: Cycle, topic: Topic, answer: Frame | None) -> None:
        """A cycle, with the node's answer on its topic."""
        while self._changes and self._changes[0].stamp <= cycle.stamp:
            change = self._changes.popleft()
            name = f"{self._prefix}/{changes.TOPIC}"
            data = changes.encode(change, f"{self._prefix}/{change.node}")
            self.write(name, changes.TYPE, change.stamp, data)
        for each in LOOP_TOPICS:
            data_ = cycle.messages.get(each.name)
            if each is topic:
                data_ = None if answer is None else self._codecs[topic.name].encode(answer)
            if data_ is not None:
                name = f"{self._prefix}/{each.name}"
                self.add_topic(name, each.type, DEPTH)
                self.write(name, each.type, cycle.stamp, data_)
