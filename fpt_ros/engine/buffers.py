"""Where the engine writes the messages of some cycles, and how they are read from there."""

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

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
from fpt_ros.runs.chunks import aligned
from fpt_ros.runs.run import Array, Series

RECORDS: dict[Topic, Any] = {
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
        noise: numbers for the sensors, a row a cycle; no columns without noise.
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
        self._arrays: dict[Topic, list[Array]] = {
            topic: [np.empty((length, len(names))) for _ in topic.vectors]
            for topic, names in self._names.items()
        }
        self.noise: Array = np.empty((length, 2 * len(plant.coordinates) if plant.noisy else 0))
        records: list[Any] = [make(*self._arrays[topic]) for topic, make in RECORDS.items()]
        self.rows = CycleRows(0, 0, *records, self.noise)  # type: ignore[call-arg]  # as many as it has

    def series(self, first: int, end: int) -> dict[str, Series]:
        """The messages of some cycles, the first in row 0; views."""
        stamps = np.arange(first, end, dtype=np.int64) * self._cycle_time
        return {
            topic.name: self._series(topic, stamps) for topic in LOOP_TOPICS if self._names[topic]
        }

    def _series(self, topic: Topic, stamps: NDArray[np.int64]) -> Series:
        vectors = {
            name: matrix[: len(stamps)]
            for name, matrix in zip(topic.vectors, self._arrays[topic], strict=True)
        }
        if topic is not DESIRED or not self._sharing:
            return Series(stamps, self._names[topic], vectors)
        absent = np.isnan(vectors["accelerations"])
        vectors = {name: np.where(absent, np.nan, each) for name, each in vectors.items()}
        return Series(stamps, self._names[topic], vectors).without_empty("accelerations")

    def put(self, row: int, topic: Topic, frame: Frame) -> None:
        """Write a frame that the Python stages gave."""
        names = self._names[topic]
        places = [names.index(name) for name in frame.names]
        for matrix, vector in zip(self._arrays[topic], frame[2:], strict=True):
            matrix[row] = np.nan
            matrix[row, places] = vector


class Whole:
    """Keeps all messages of a run: a consumer for those who need whole arrays."""

    def __init__(self, cycles: int) -> None:
        """``cycles``: at most so many come; memory is taken as they do."""
        self._cycles = cycles
        self._kept: dict[str, Series] = {}
        self._done = 0

    def take(self, chunk: Mapping[str, Series]) -> None:
        """Copy some cycles."""
        first = end = self._done
        for topic, series in chunk.items():
            room = self._kept[topic] = self._room(self._kept.get(topic), series)
            end = first + len(series.stamps)
            room.stamps[first:end] = series.stamps
            for key, matrix in room.vectors.items():
                matrix[first:end] = aligned(series, key, room.names)
        self._done = end

    def _room(self, room: Series | None, series: Series) -> Series:
        """For all cycles; of ``desired``, coordinates that had no turn yet may come later."""
        if room is None:
            shape = self._cycles, len(series.names)
            vectors = {key: np.empty(shape) for key in series.vectors}
            return Series(np.empty(self._cycles, dtype=np.int64), series.names, vectors)
        names = tuple(dict.fromkeys(room.names + series.names))
        if names == room.names:
            return room
        return Series(room.stamps, names, {key: aligned(room, key, names) for key in room.vectors})

    def topics(self) -> dict[str, Series]:
        """All so far; of ``desired`` the coordinates that have had a turn."""
        return {topic: room.head(self._done) for topic, room in self._kept.items()}
