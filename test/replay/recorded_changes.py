"""Runs with changes in flight, recorded as the recorder would: without the graph, which is slow."""

from collections.abc import Callable
from pathlib import Path

from fpt_ros.bags import changes as messages
from fpt_ros.bags.writer import BagWriter
from fpt_ros.cycle.run import NO_CHANGES, Changes, Run
from fpt_ros.experiments.experiment import load
from fpt_ros.messages.cdr import Codec
from fpt_ros.messages.frames import Frame
from fpt_ros.messages.topics import COMMAND, LOOP_TOPICS, Topic
from fpt_ros.runs.changes import Change

TOLD_LATER = 3
"""Cycles after which a change is recorded."""

INFO = {"experiment": "x", "variant": "y", "engine": "graph", "clock": "lockstep"}


def recorded(
    directory: Path,
    name: str,
    cycles: int,
    changes: Changes = NO_CHANGES,
    alter: Callable[[Topic, Frame], Frame | None] = lambda topic, frame: frame,
    info: dict[str, str] = INFO,
) -> Path:
    """An experiment, with what ``alter`` makes of its messages; None: the message is lost."""
    experiment = load(name)
    loop = experiment.loop()
    late = TOLD_LATER * loop.plant.cycle_time
    codecs = {topic.name: Codec(topic) for topic in LOOP_TOPICS}
    with BagWriter(directory, experiment.nodes, info) as bag:
        for topic, frame in Run(loop, changes=changes).frames(cycles):
            altered = alter(topic, frame)
            if altered is not None:
                data = codecs[topic.name].encode(altered)
                bag.write(f"/{topic.name}", topic.type, altered.stamp, data)
            if topic is COMMAND:  # changes are told later than the cycle that they mean
                cycle = frame.stamp // loop.plant.cycle_time - TOLD_LATER
                for node, values in changes.get(cycle, {}).items():
                    data = messages.encode(Change(node, frame.stamp - late, values), f"/{node}")
                    bag.write(f"/{messages.TOPIC}", messages.TYPE, frame.stamp, data)
    return directory
