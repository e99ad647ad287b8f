"""A recorded run cycle by cycle: the bytes that its nodes said to each other."""

import heapq
import struct
from collections import Counter
from collections.abc import Iterator, Mapping
from copy import copy
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple, Self

from fpt_ros.bags import begun_again, contents
from fpt_ros.bags.bag import Bag
from fpt_ros.bags.loop_series import loop_topic
from fpt_ros.cycle.denoiser import Denoiser
from fpt_ros.cycle.plant_simulator import PlantSimulator
from fpt_ros.cycle.stage import ROBOT
from fpt_ros.cycle.stages import STAGES
from fpt_ros.errors import BadInput
from fpt_ros.experiments.parameter_file import ParameterFile
from fpt_ros.experiments.sections import resolved
from fpt_ros.messages.frames import SECOND
from fpt_ros.messages.topics import BY_NAME, Topic
from fpt_ros.parameters import Value, Values
from fpt_ros.runs.changes import Change

_STAMP = struct.Struct("<iI")
_SWAPPED = struct.Struct(">iI")
_HEAD = 4 + _STAMP.size


class Cycle(NamedTuple):
    """What is recorded of one cycle.

    Attributes:
        number: from the start of the run.
        stamp: of all its messages [ns].
        messages: by the name of the topic; one that was not published, or is lost, is absent.
    """

    number: int
    stamp: int
    messages: dict[str, bytes]


class Recorded:
    """A recording of the loop, read twice: what it says of itself, then its cycles as they come.

    Attributes:
        path: as it was given.
        info: experiment, variant, version, complete, reason, ...
        parameters: by node, complete, as at the start.
        changes: of parameters in flight.
        missing: what of the recording is damaged or not there, a line each.
        realtime: on the wall clock; else in lockstep, where cycle k has the stamp k dt.
        prefix: namespace of its topics, as in ``/robot1``, or empty.
        counts: messages by the name of the topic.
        cycle_time: [ns].
        total: cycles from the first to the last one; in real time at least.
    """

    def __init__(self, path: Path) -> None:
        """Read what it says of itself.

        Raises:
            BadInput: it is not a recording of the loop, or of one that begins again.
        """
        self.path = path
        bag = Bag(path)
        aside = contents.Aside(bag)
        last = 0
        for block in bag.blocks():
            aside.take(block)
            for source, rows in block.rows.items():
                if len(rows) and aside.is_of_the_loop(source):
                    last = max(last, int(rows[:, 0].max()))
        if aside.begun_again:
            raise BadInput(
                f"{path}: the run was reset at {begun_again.text(aside.begun_again)}: what began "
                "again cannot be run again"
            )
        self.parameters: dict[str, dict[str, Value]] = contents.parameters(bag)
        self.info = contents.ending(bag)
        self.changes: tuple[Change, ...] = tuple(aside.changes)
        self.missing = tuple(bag.missing)
        self.realtime = self.info.get("clock") == "realtime"
        self.prefix = contents.namespace(bag).rstrip("/")
        self.counts: Counter[str] = Counter()
        for source, count in bag.counts.items():
            if count and aside.is_of_the_loop(source):
                self.counts[source.topic.rpartition("/")[2]] += count
        if not self.counts:
            raise BadInput(
                f"{path} holds no messages on the loop's topics: {', '.join(BY_NAME)}"
                + (f" ({'; '.join(self.missing)})" if self.missing else "")
            )
        self.cycle_time = self._cycle_time()
        self.total = max(self.counts.values()) if self.realtime else last // self.cycle_time + 1

    @property
    def complete(self) -> bool:
        """The run came to its end, and all of it is there."""
        return self.info["complete"] == "true"

    @property
    def nodes(self) -> list[str]:
        """The nodes of the loop whose messages are recorded, in the order of events."""
        robot = self.parameters.get(Denoiser.name, {}).get(ROBOT.name) is True
        return [
            name
            for name, stage in STAGES.items()
            if name in self.parameters and stage.output.name in self.counts
            if not (robot and stage is PlantSimulator)
        ]

    def with_settings(self, settings: Mapping[str, Values]) -> Self:
        """The same run with other parameters, which hold from the start to the end.

        Args:
            settings: by node; recorded changes of these parameters are left out.

        Raises:
            BadInput: there is no such node, or a setting is not valid.
        """
        other, base = copy(self), ParameterFile(nodes=dict(self.parameters))
        file = base.overlay(ParameterFile(nodes={name: dict(v) for name, v in settings.items()}))
        for node, values in settings.items():
            if node not in self.parameters:
                there = ", ".join(self.parameters)
                raise BadInput(f"{self.path} has no node '{node}': it has {there}")
            explicit = {(node, name) for name in values}
            now = resolved(node, file, [base], explicit)
            other.parameters = {**other.parameters, node: now}
        kept = [
            replace(change, values={k: v for k, v in change.values.items() if k not in given})
            for change in self.changes
            for given in [settings.get(change.node, {})]
        ]
        other.changes = tuple(change for change in kept if change.values)
        return other

    def cycles(self) -> Iterator[Cycle]:
        """All cycles, in their order.

        Raises:
            BadInput: in lockstep, the first one is not cycle 0.
        """
        origin: int | None = None
        for stamp, messages in self._by_stamp():
            if origin is None:
                origin = stamp if self.realtime else 0
                if stamp != origin:
                    raise BadInput(
                        f"{self.path} begins at t = {stamp / SECOND:g} s: what the nodes remember "
                        "from before is not in it (of a split recording give the folder)"
                    )
            yield Cycle(round((stamp - origin) / self.cycle_time), stamp, messages)

    def _by_stamp(self) -> Iterator[tuple[int, dict[str, bytes]]]:
        """A cycle is complete when every topic has gone on, or ended."""
        latest = dict.fromkeys(self.counts, -1)
        waiting: dict[int, dict[str, bytes]] = {}
        stamps: list[int] = []
        behind = -1
        for topic, data in self._messages():
            stamp = stamp_of(data)
            if stamp <= latest[topic.name]:
                continue  # twice the same, or of another run: a node ignores it
            slowest = latest[topic.name] == behind
            latest[topic.name] = stamp
            if stamp not in waiting:
                waiting[stamp] = {}
                heapq.heappush(stamps, stamp)
            waiting[stamp][topic.name] = data
            if slowest:
                behind = min(latest.values())
                while stamps and stamps[0] <= behind:
                    first = heapq.heappop(stamps)
                    yield first, waiting.pop(first)
        while stamps:
            first = heapq.heappop(stamps)
            yield first, waiting.pop(first)

    def _messages(self) -> Iterator[tuple[Topic, bytes]]:
        """The loop's messages, in the order in which they were written."""
        bag = Bag(self.path)
        aside = contents.Aside(bag)
        for block in bag.blocks():
            for source, (_, start, end, _) in block.ordered():
                topic = loop_topic(source)
                if topic is not None and end - start >= _HEAD and aside.is_of_the_loop(source):
                    yield topic, bytes(block.data[start:end])

    def _cycle_time(self) -> int:
        """Of the run [ns]: the plant's, or what its nodes were told."""
        plant = self.parameters.get(PlantSimulator.name, {})
        given = [plant.get("dt"), *(each.get("cycle_time") for each in self.parameters.values())]
        known = [float(each) for each in given if isinstance(each, int | float) and each > 0]
        if not known:
            raise BadInput(f"{self.path}: its parameters do not tell the cycle time")
        return round(known[0] * SECOND)


def stamp_of(data: bytes) -> int:
    """The stamp [ns] in front of every message of the loop."""
    seconds, nanoseconds = (_STAMP if data[1] & 1 else _SWAPPED).unpack_from(data, 4)
    return int(seconds) * SECOND + int(nanoseconds)
