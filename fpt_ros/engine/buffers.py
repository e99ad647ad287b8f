"""Where the engine writes the messages of some cycles, and how they are read from there."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from fpt_ros.cycle.loop import CycleRows
from fpt_ros.cycle.rows import (
    CommandRows,
    DesiredRows,
    JointStatesRows,
    StateEstimateRows,
    TuningRows,
)
from fpt_ros.cycle.stages import Loop
from fpt_ros.messages.frames import Frame, Names
from fpt_ros.messages.topics import (
    COMMAND,
    DESIRED,
    JOINT_STATES,
    LOOP_TOPICS,
    STATE_ESTIMATE,
    TUNING,
    Topic,
)
from fpt_ros.runs.run import Series, joined

RECORDS = {
    JOINT_STATES: JointStatesRows,
    STATE_ESTIMATE: StateEstimateRows,
    DESIRED: DesiredRows,
    TUNING: TuningRows,
    COMMAND: CommandRows,
}


class Buffers:
    """Rows for the messages of at most ``length`` cycles, used again and again.

    Attributes:
        rows: what the loop writes.
    """

    def __init__(self, loop: Loop, length: int) -> None:
        plant, tuner = loop.plant, loop.tuner
        self._cycle_time = plant.cycle_time
        self._sharing = bool(loop.trajectory.constants.slots)
        self._names: dict[Topic, Names] = {
            JOINT_STATES: plant.coordinates,
            STATE_ESTIMATE: plant.coordinates,
            DESIRED: loop.trajectory.controlled,
            TUNING: tuner.published if tuner.active else (),
            COMMAND: plant.coordinates,
        }
        records = {
            topic: record(*[np.empty((length, len(self._names[topic]))) for _ in topic.vectors])
            for topic, record in RECORDS.items()
        }
        width = 2 * len(plant.coordinates) if plant.noisy else 0
        rows: Any = (*records.values(), np.empty((length, width)))
        self.rows = CycleRows(*rows)

    def series(self, first: int, end: int) -> dict[str, Series]:
        """The messages of some cycles, the first in row 0; views."""
        stamps = np.arange(first, end, dtype=np.int64) * self._cycle_time
        return {
            topic.name: self._series(topic, stamps) for topic in LOOP_TOPICS if self._names[topic]
        }

    def _series(self, topic: Topic, stamps: "np.ndarray[tuple[int], np.dtype[np.int64]]") -> Series:
        rows = self.rows[LOOP_TOPICS.index(topic)]
        vectors = {
            name: matrix[: len(stamps)]
            for name, matrix in zip(topic.vectors, rows, strict=True)  # type: ignore[arg-type]
        }
        if topic is DESIRED and self._sharing:
            absent = np.isnan(vectors["accelerations"])
            vectors = {name: np.where(absent, np.nan, each) for name, each in vectors.items()}
        return Series(stamps, self._names[topic], vectors)

    def put(self, row: int, topic: Topic, frame: Frame) -> None:
        """Write a frame that the Python stages gave."""
        names = self._names[topic]
        places = [names.index(name) for name in frame.names]
        rows = self.rows[LOOP_TOPICS.index(topic)]
        for matrix, vector in zip(rows, frame[2:], strict=True):  # type: ignore[arg-type]
            matrix[row] = np.nan
            matrix[row, places] = vector


class Whole:
    """Keeps all messages of a run: a consumer for those who need whole arrays."""

    def __init__(self) -> None:
        self._chunks: list[dict[str, Series]] = []

    def take(self, chunk: Mapping[str, Series]) -> None:
        """Copy some cycles."""
        self._chunks.append({name: series.copy() for name, series in chunk.items()})

    def topics(self) -> dict[str, Series]:
        """All so far, joined; of ``desired`` the coordinates that have had a turn."""
        if not self._chunks:
            return {}
        names = self._chunks[0]
        whole = {name: joined([chunk[name] for chunk in self._chunks]) for name in names}
        whole[DESIRED.name] = whole[DESIRED.name].without_empty("accelerations")
        self._chunks = [whole]
        return whole
