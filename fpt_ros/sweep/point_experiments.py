"""From a point of a sweep to its experiment.

The parameter files are read once in a process. A change of numbers is then laid on the resolved
parameters and checked by the same ``Parameter`` and by the stages, as the loader does it.
"""

import json
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from fpt_ros.cycle.stages import Loop
from fpt_ros.errors import BadInput
from fpt_ros.experiments import description
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.experiments.sections import SECTIONS
from fpt_ros.parameters import Parameter, Value, resolve
from fpt_ros.sweep.files import at_hand
from fpt_ros.sweep.grid import Point, is_number
from fpt_ros.sweep.job import Job

KEPT = 32
"""Resolved experiments that are kept of a job: one for each combination of words."""

JOBS = 4
"""Jobs that a process remembers."""

Key = tuple[str, str]
"""Node and name of a parameter."""


@dataclass(frozen=True)
class ResolvedExperiment:
    """A resolved experiment on which numbers are changed.

    Attributes:
        experiment: complete.
        targets: for each parameter that is varied, the nodes that it goes to, with its definition.
    """

    experiment: Experiment
    targets: Mapping[Key, Sequence[tuple[str, Parameter]]]

    def variant(self, changes: Mapping[Key, Value]) -> tuple[Experiment, Loop]:
        """The experiment with these values, and its stages.

        Raises:
            BadInput: one is not valid, or they do not fit.
        """
        nodes = dict(self.experiment.nodes)
        for key, value in changes.items():
            for node, parameter in self.targets[key]:
                nodes[node] = {**nodes[node], parameter.name: parameter.check(value, node)}
        about = nodes[description.NODE]
        resolve(SECTIONS[description.NODE](about), about, description.NODE)
        experiment = replace(self.experiment, nodes=nodes)
        return experiment, experiment.loop()


class Experiments:
    """The experiments of a job, point by point.

    Values that are not numbers may change which parameters there are: each combination of them has
    a resolved experiment of its own.
    """

    def __init__(self, job: Job) -> None:
        self.job = job
        axes = job.space.axes
        self._words = [at for at, axis in enumerate(axes) if not axis.numeric]
        self._word_keys = {(axes[at].target.node, axes[at].target.name) for at in self._words}
        self._resolved: dict[str, ResolvedExperiment] = {}

    def at(self, point: Point) -> tuple[Experiment, Loop]:
        """The experiment of a point, and its stages.

        Raises:
            BadInput: the parameters of this point are not valid together.
        """
        key = repr([point[at] for at in self._words])
        resolved = self._resolved.get(key)
        if resolved is None:
            experiment = self.job.load(point)
            if len(self._resolved) >= KEPT:
                self._resolved.pop(next(iter(self._resolved)))
            self._resolved[key] = self._resolve(point, experiment)
            return experiment, experiment.loop()
        changes = self._changes(point)
        if all(target in resolved.targets for target in changes):
            try:
                return resolved.variant(changes)
            except BadInput:
                pass  # the loader has the last word
        experiment = self.job.load(point)
        return experiment, experiment.loop()

    def _changes(self, point: Point) -> dict[Key, Value]:
        every = self.job.values(point)
        return {key: value for key, value in every.items() if key not in self._word_keys}

    def _resolve(self, point: Point, experiment: Experiment) -> ResolvedExperiment:
        """Find out where each number goes: the loader says it, for a value that is close by."""
        targets = {}
        for key, value in self._changes(point).items():
            for near in _neighbours(value):
                try:
                    other = self.job.load(point, f"{key[0]}.{key[1]}={json.dumps(near)}")
                except BadInput:
                    continue
                found = _differences(key[1], experiment, other)
                if found:
                    targets[key] = found
                    break
        return ResolvedExperiment(experiment, targets)


def experiments_of(job: Job) -> Experiments:
    """Those of a job; a process keeps what it has found out about the last few."""
    key = repr(job)  # jobs with 1, 1.0 and True are equal
    found = _known.get(key)
    if found is None:
        if len(_known) >= JOBS:
            _known.pop(next(iter(_known)))
        found = _known[key] = Experiments(at_hand(job))
    return found


_known: dict[str, Experiments] = {}


def _neighbours(value: Value) -> list[Value]:
    """Values beside a number, or beside a list of numbers."""
    if isinstance(value, int) and not isinstance(value, bool):
        return [value + 1, value - 1]
    if isinstance(value, float):
        return [math.nextafter(value, math.inf), math.nextafter(value, -math.inf)]
    if isinstance(value, list) and value and is_number(value[0]):
        first = float(value[0])
        sides = (math.nextafter(first, math.inf), math.nextafter(first, -math.inf))
        return [[side, *value[1:]] for side in sides]
    return []


def _differences(
    name: str, one: Experiment, other: Experiment
) -> Sequence[tuple[str, Parameter]] | None:
    """Nodes in which only ``name`` differs; ``None`` where anything else does."""
    found = []
    for node, before in one.nodes.items():
        after = other.nodes[node]
        differing = [key for key in {**before, **after} if before.get(key) != after.get(key)]
        if differing == [name]:
            known: Callable[..., tuple[Parameter, ...]] = SECTIONS[node]
            found += [(node, each) for each in known(before) if each.name == name]
        elif differing:
            return None
    return found
