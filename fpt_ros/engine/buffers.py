"""Where the engine writes the messages of some cycles, and how they are read from there."""

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
from fpt_ros.runs.run import Array, Series

RECORDS: dict[Topic, Any] = {
    JOINT_STATES: JointStatesRows,
    STATE_ESTIMATE: StateEstimateRows,
    DESIRED: DesiredRows,
    TUNING: TuningRows,
    COMMAND: CommandRows,
}


class Buffers:
    """Rows for the messages of ``length`` cycles, at first of those from 0 on."""

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
        self._first = 0

    def begin(self, cycle: int) -> None:
        """Use all rows again, for the cycles from this one on."""
        self._first = cycle

    def rows(self, first: int, end: int, noise: Array) -> CycleRows:
        """What the loop writes in some cycles; of ``noise`` it reads a row for each."""
        at = slice(first - self._first, end - self._first)
        records: list[Any] = [
            make(*[matrix[at] for matrix in self._arrays[topic]]) for topic, make in RECORDS.items()
        ]
        return CycleRows(first, end, *records, noise)  # type: ignore[call-arg]  # as many as it has

    def series(self, first: int, end: int) -> dict[str, Series]:
        """The messages of some cycles; views."""
        stamps = np.arange(first, end, dtype=np.int64) * self._cycle_time
        at = slice(first - self._first, end - self._first)
        return {
            topic.name: self._series(topic, stamps, at)
            for topic in LOOP_TOPICS
            if self._names[topic]
        }

    def _series(self, topic: Topic, stamps: NDArray[np.int64], at: slice) -> Series:
        vectors = {
            name: matrix[at]
            for name, matrix in zip(topic.vectors, self._arrays[topic], strict=True)
        }
        if topic is not DESIRED or not self._sharing:
            return Series(stamps, self._names[topic], vectors)
        absent = np.isnan(vectors["accelerations"])
        vectors = {name: np.where(absent, np.nan, each) for name, each in vectors.items()}
        return Series(stamps, self._names[topic], vectors).without_empty("accelerations")

    def put(self, cycle: int, topic: Topic, frame: Frame) -> None:
        """Write a frame that the Python stages gave."""
        names, row = self._names[topic], cycle - self._first
        places = [names.index(name) for name in frame.names]
        for matrix, vector in zip(self._arrays[topic], frame[2:], strict=True):
            matrix[row] = np.nan
            matrix[row, places] = vector
