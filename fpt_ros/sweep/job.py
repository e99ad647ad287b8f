"""All that a process has to know of a sweep, and what it gives back for a run."""

import json
from dataclasses import dataclass
from typing import Any, cast

from fpt_ros.experiments.experiment import Experiment, load
from fpt_ros.parameters import Value
from fpt_ros.sweep.grid import Point, Space

COMPLETE, DIVERGED, INVALID, FAILED = "complete", "diverged", "invalid", "failed"
"""What can become of a run: ``invalid`` is one whose parameters do not go together."""

RESULT = ("outcome", "diverged_at", "reason", "cycles")
"""Columns between the parameters and the metrics."""

Row = list[Any]
"""Number of the run, its parameters, :data:`RESULT`, its metrics."""


@dataclass(frozen=True)
class Job:
    """All that a process has to know of a sweep.

    Attributes:
        name, variant, settings, duration: as of :func:`~fpt_ros.experiments.experiment.load`.
        space: the points.
        lists: ``NODE.PARAM`` of which single elements are varied, and the whole list.
        metrics: columns of the results.
        files: path and text of the parameter files that are not the package's.
    """

    name: str
    variant: str
    settings: tuple[str, ...]
    duration: float | None
    space: Space
    lists: tuple[tuple[str, tuple[float, ...]], ...]
    metrics: tuple[str, ...]
    files: tuple[tuple[str, str], ...] = ()

    @property
    def columns(self) -> list[str]:
        """Names of the numbers in a row."""
        return ["run", *(str(axis.target) for axis in self.space.axes), *RESULT, *self.metrics]

    def values(self, point: Point) -> dict[tuple[str, str], Value]:
        """Whole parameters of a point by (node, name): elements are put into their lists."""
        lists = {name: list(value) for name, value in self.lists}
        found: dict[tuple[str, str], Value] = {}
        for axis, value in zip(self.space.axes, point, strict=True):
            target = axis.target
            if target.index is None:
                found[target.node, target.name] = list(value) if isinstance(value, tuple) else value
            else:
                whole = lists[target.parameter]
                whole[target.index] = cast("float", value)
                found[target.node, target.name] = whole
        return found

    def options(self, point: Point) -> list[str]:
        """The ``--set`` of ``fpt simulate`` for a point, the sweep's own ones first."""
        own = [f"{node}.{name}={json.dumps(v)}" for (node, name), v in self.values(point).items()]
        return [*self.settings, *own]

    def load(self, point: Point, *more: str) -> Experiment:
        """What ``fpt simulate`` would run for a point, with ``more`` settings.

        Raises:
            BadInput: the parameters of this point are not valid together.
        """
        return load(self.name, self.variant, [*self.options(point), *more], self.duration)
