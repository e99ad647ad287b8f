"""A run as arrays: what analysis works on, whether it comes from the engine or from a recording."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fpt_ros import __version__
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.messages.frames import SECOND, Names
from fpt_ros.parameters import Value
from fpt_ros.runs.changes import Change
from fpt_ros.runs.cost import Cost
from fpt_ros.runs.latency import Latencies

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Series:
    """All frames of one topic.

    Attributes:
        stamps: (N,) int64, [ns].
        names: of the m columns.
        vectors: name of the frame's vector -> (N, m) numbers, NaN where a frame lacks the column.
    """

    stamps: NDArray[np.int64]
    names: Names
    vectors: Mapping[str, Array]

    @property
    def time(self) -> Array:
        """(N,) times [s]."""
        return self.stamps / SECOND

    def column(self, vector: str, name: str) -> Array:
        """(N,) numbers of one name."""
        return self.vectors[vector][:, self.names.index(name)]

    def copy(self) -> "Series":
        """The same in arrays of its own."""
        vectors = {name: matrix.copy() for name, matrix in self.vectors.items()}
        return Series(self.stamps.copy(), self.names, vectors)

    def head(self, count: int) -> "Series":
        """The first frames; views."""
        vectors = {name: matrix[:count] for name, matrix in self.vectors.items()}
        return Series(self.stamps[:count], self.names, vectors)

    def without_empty(self, vector: str) -> "Series":
        """The same without the names of which this vector has no number at all."""
        found = np.asarray(~np.isnan(self.vectors[vector]).all(axis=0))
        if found.all():
            return self
        names = tuple(name for name, there in zip(self.names, found, strict=True) if there)
        return Series(
            self.stamps, names, {name: each[:, found] for name, each in self.vectors.items()}
        )


@dataclass(frozen=True)
class Run:
    """Everything about one run.

    Attributes:
        info: experiment, variant, engine, version, complete, reason, ...
        parameters: of every node, complete, as at the start.
        topics: by topic name; one that nobody published is absent.
        latency: from sensor to command, of a run in real time.
        changes: of parameters in flight, in the order in which they came.
        costs: what its processes took of the machine, where they told it.
    """

    info: Mapping[str, str]
    parameters: Mapping[str, Mapping[str, Value]]
    topics: Mapping[str, Series]
    latency: Latencies | None = None
    changes: tuple[Change, ...] = ()
    costs: tuple[Cost, ...] = ()


def describe(experiment: Experiment, engine: str, reason: str) -> dict[str, str]:
    """The ``info`` of a run: ``engine`` is in_process or graph, ``reason`` empty if complete."""
    return {
        "experiment": experiment.name,
        "variant": experiment.variant,
        "engine": engine,
        "version": __version__,
        "complete": "false" if reason else "true",
        "reason": reason,
    }
