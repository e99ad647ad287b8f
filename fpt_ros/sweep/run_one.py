"""One variant of a sweep: from its number to its row, in whatever process.

The parameter files are read once in a process. A change of numbers is then laid on the resolved
parameters and checked by the same ``Parameter`` and by the stages, as the loader does it.
"""

import json
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from time import perf_counter
from typing import Any, cast

from fpt_ros.analysis.metrics import summary
from fpt_ros.errors import BadInput, Diverged, RunFailed
from fpt_ros.loop import description
from fpt_ros.loop.engine import Engine
from fpt_ros.loop.experiment import SECTIONS, Experiment, Loop, load
from fpt_ros.loop.run import Run, describe
from fpt_ros.parameters import Parameter, Value, resolve
from fpt_ros.sweep.grid import Point, Space, is_number

COMPLETE, DIVERGED, INVALID, FAILED = "complete", "diverged", "invalid", "failed"
"""What can become of a run: ``invalid`` is one whose parameters do not go together."""

RESULT = ("outcome", "diverged_at", "reason", "cycles")
"""Columns between the parameters and the metrics."""

Row = list[Any]
"""Number of the run, its parameters, :data:`RESULT`, its metrics."""

_TRACKING = ("rms_settled", "max_settled", "rms", "max")
_EFFORT = {"effort": "rms", "effort_max": "max"}
_FINAL = "final."

GROUNDS = 32
"""Resolved experiments that a process keeps: one for each combination of words."""


@dataclass(frozen=True)
class Job:
    """All that a process has to know of a sweep.

    Attributes:
        name, variant, settings, duration: as of :func:`~fpt_ros.loop.experiment.load`.
        space: the points.
        lists: ``NODE.PARAM`` of which single elements are varied, and the whole list.
        metrics: columns of the results.
    """

    name: str
    variant: str
    settings: tuple[str, ...]
    duration: float | None
    space: Space
    lists: tuple[tuple[str, tuple[float, ...]], ...]
    metrics: tuple[str, ...]

    @property
    def columns(self) -> list[str]:
        """Names of the numbers in a row."""
        return ["run", *(str(axis.target) for axis in self.space.axes), *RESULT, *self.metrics]


@dataclass(frozen=True)
class Ground:
    """A resolved experiment on which numbers are changed.

    Attributes:
        experiment: complete.
        targets: for each parameter that is varied, the nodes that it goes to, with its definition.
    """

    experiment: Experiment
    targets: Mapping[tuple[str, str], Sequence[tuple[str, Parameter]]]

    def variant(self, changes: Mapping[tuple[str, str], Value]) -> tuple[Experiment, Loop]:
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
        experiment = Experiment(self.experiment.name, self.experiment.variant, nodes)
        return experiment, experiment.loop()


def run_chunk(job: Job, numbers: Sequence[int]) -> tuple[float, list[Row]]:
    """Seconds that it took, and the rows of some runs: what is given to a pool."""
    started = perf_counter()
    rows = [run_one(job, number) for number in numbers]
    return perf_counter() - started, rows


def run_one(job: Job, number: int) -> Row:
    """The row of one run, whatever becomes of it."""
    point = job.space.point(number)
    outcome, at, result = COMPLETE, None, None
    reason = ""
    try:
        result = simulate(*experiment_at(job, point))
        reason = str(result["reason"])
        if reason:
            outcome, at = DIVERGED, cast("float | None", result["diverged_at"])
            outcome = FAILED if at is None else DIVERGED
    except BadInput as error:
        outcome, reason = INVALID, str(error)
    except Exception as error:  # one run that fails shall not end a thousand others
        outcome, reason = FAILED, f"{type(error).__name__}: {error}"
    cycles = 0 if result is None else result["cycles"]
    metrics = [None if result is None else metric(result, name) for name in job.metrics]
    shown = [list(value) if isinstance(value, tuple) else value for value in point]
    return [number, *shown, outcome, at, reason, cycles, *metrics]


def simulate(experiment: Experiment, loop: Loop) -> dict[str, object]:
    """The summary of a run as ``fpt simulate`` gives it, and ``diverged_at`` [s]."""
    engine = Engine(loop)
    reason, at = "", None
    try:
        engine.run()
    except RunFailed as error:
        reason = str(error)
        at = error.time if isinstance(error, Diverged) else None
    info = describe(experiment, "in_process", reason)
    return {**summary(Run(info, experiment.nodes, engine.topics())), "diverged_at": at}


def experiment_at(job: Job, point: Point) -> tuple[Experiment, Loop]:
    """The experiment of a point, and its stages.

    Raises:
        BadInput: the parameters of this point are not valid together.
    """
    key = (job, repr(_words(job, point)))
    ground = _grounds.get(key)
    if ground is None:
        experiment = load(job.name, job.variant, settings(job, point), job.duration)
        if len(_grounds) >= GROUNDS:
            _grounds.pop(next(iter(_grounds)))
        _grounds[key] = _ground(job, point, experiment)
        return experiment, experiment.loop()
    changes = _changes(job, point)
    if all(target in ground.targets for target in changes):
        try:
            return ground.variant(changes)
        except BadInput:
            pass  # the loader has the last word
    experiment = load(job.name, job.variant, settings(job, point), job.duration)
    return experiment, experiment.loop()


_grounds: dict[tuple[Job, str], Ground] = {}


def settings(job: Job, point: Point) -> list[str]:
    """The ``--set`` of ``fpt simulate`` for a point, the sweep's own ones first."""
    own = [f"{node}.{name}={json.dumps(v)}" for (node, name), v in _all(job, point).items()]
    return [*job.settings, *own]


def metric(result: Mapping[str, object], name: str) -> float | None:
    """One number of a summary by the name that ``--metric`` has for it."""
    if name == "chatter":
        return cast("float | None", result["chatter"])
    kind, _, of = name.partition(".")
    if name.startswith(_FINAL):
        return cast("Mapping[str, float | None]", result["final_parameters"]).get(of)
    part, key = ("effort", _EFFORT[kind]) if kind in _EFFORT else ("tracking", kind)
    return cast("Mapping[str, Mapping[str, float | None]]", result[part]).get(of, {}).get(key)


def metrics_of(loop: Loop, wanted: Sequence[str] = ()) -> tuple[str, ...]:
    """Names of the numbers that a run has; ``rms_settled`` alone stands for all coordinates.

    Raises:
        BadInput: a run has no such number.
    """
    controlled, plant = loop.trajectory.controlled, loop.plant.coordinates
    known = [f"{kind}.{name}" for name in controlled for kind in _TRACKING]
    known += [f"{kind}.{name}" for name in plant for kind in _EFFORT]
    known.append("chatter")
    final = [_FINAL + name for name in _final(loop)]
    found: list[str] = []
    for name in wanted:
        group = [each for each in known if each.startswith(name + ".")]
        if name not in known and name not in final and not group:
            hint = f", {_FINAL}{{{','.join(_final(loop))}}}" if final else ""
            raise BadInput(f"there is no metric '{name}': there are {', '.join(known)}{hint}")
        found += group or [name]
    return tuple(dict.fromkeys(found)) if wanted else tuple(known)


def _final(loop: Loop) -> tuple[str, ...]:
    names = loop.deformer.model.coefficient_names
    return tuple(dict.fromkeys((*names, *(loop.tuner.published if loop.tuner.active else ()))))


def _all(job: Job, point: Point) -> dict[tuple[str, str], Value]:
    """Parameters of a point, whole: elements are put into their lists."""
    lists = {name: list(value) for name, value in job.lists}
    found: dict[tuple[str, str], Value] = {}
    for axis, value in zip(job.space.axes, point, strict=True):
        target = axis.target
        if target.index is None:
            found[target.node, target.name] = list(value) if isinstance(value, tuple) else value
        else:
            whole = lists[target.parameter]
            whole[target.index] = cast("float", value)
            found[target.node, target.name] = whole
    return found


def _words(job: Job, point: Point) -> list[Value]:
    """What may change which parameters there are: all values that are not numbers."""
    axes = job.space.axes
    return [value for axis, value in zip(axes, point, strict=True) if not axis.numeric]


def _changes(job: Job, point: Point) -> dict[tuple[str, str], Value]:
    words = {(a.target.node, a.target.name) for a in job.space.axes if not a.numeric}
    return {key: value for key, value in _all(job, point).items() if key not in words}


def _ground(job: Job, point: Point, experiment: Experiment) -> Ground:
    """Find out where each number goes: the loader says it, for a value that is close by."""
    targets = {}
    for key, value in _changes(job, point).items():
        for near in _neighbours(value):
            setting = f"{key[0]}.{key[1]}={json.dumps(near)}"
            try:
                other = load(job.name, job.variant, [*settings(job, point), setting], job.duration)
            except BadInput:
                continue
            found = _differences(key[1], experiment, other)
            if found:
                targets[key] = found
                break
    return Ground(experiment, targets)


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
