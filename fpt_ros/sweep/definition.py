"""What a sweep is: its axes checked against the experiment, its points, its metrics."""

import hashlib
import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import islice, product
from pathlib import Path
from typing import Any, cast

from fpt_ros import __version__
from fpt_ros.errors import BadInput
from fpt_ros.experiments.experiment import Experiment, is_path, load
from fpt_ros.experiments.sections import SECTIONS
from fpt_ros.parameters import Parameter, Value
from fpt_ros.sweep.files import texts_of
from fpt_ros.sweep.grid import Axis, Space, parse, values
from fpt_ros.sweep.job import Job
from fpt_ros.sweep.metric import metrics_of

COMBINATIONS = 64
"""Combinations of words that are looked at for one that has all parameters."""

PER_COORDINATE = ("initial_position", "initial_velocity")
"""Lists that are zero for all coordinates where they are empty."""


@dataclass(frozen=True)
class Sweep:
    """A sweep whose definition has been checked.

    Attributes:
        experiment: at its first point without the axes.
        job: what workers are given.
        definition: what is stored, and compared when a sweep goes on.
    """

    experiment: Experiment
    job: Job
    definition: Mapping[str, Any]

    @property
    def size(self) -> int:
        """Number of runs."""
        return self.job.space.size


def define(
    name: str,
    variant: str,
    settings: Sequence[str],
    duration: float | None,
    grids: Sequence[str],
    random: int | None,
    seed: int,
    metrics: Sequence[str],
) -> Sweep:
    """Check what is asked for, and read the experiment once.

    Raises:
        BadInput: an unknown parameter or metric, a value that no run could take, no points.
    """
    if random is not None and random < 1:
        raise BadInput(f"--random {random} is not valid, it takes 1 or more")
    if seed < 0:
        raise BadInput(f"--seed {seed} is not valid, it takes 0 or more")
    if not grids:
        raise BadInput("a sweep takes at least one --grid, as in --grid fpt_deformer.A=-0.1:-4:64")
    axes = [parse(text, random is not None) for text in grids]
    _check_distinct(axes)
    name, variant = (str(Path(it).absolute()) if is_path(it) else it for it in (name, variant))
    bare = load(name, variant, settings, duration)
    experiment = _first_with_all(
        bare, axes, lambda words: load(name, variant, words, duration), settings
    )
    lists: dict[str, tuple[float, ...]] = {}
    axes = [_checked(axis, experiment, lists) for axis in axes]
    space = Space(tuple(axes), random or 0, seed if random else 0)
    chosen = metrics_of(experiment.loop(), metrics)
    files = texts_of(name, variant)
    job = Job(name, variant, tuple(settings), duration, space, tuple(lists.items()), chosen, files)
    definition = {
        "experiment": name,
        "variant": variant,
        "set": list(settings),
        "duration": duration,
        "grid": list(grids),
        "random": space.random,
        "seed": space.seed,
        "metrics": list(chosen),
        "runs": space.size,
        "parameters": _digest(bare),
        "version": __version__,
    }
    return Sweep(experiment, job, definition)


def parameter_of(experiment: Experiment, node: str, name: str) -> Parameter:
    """The definition of a parameter.

    Raises:
        BadInput: there is none, with those that there are.
    """
    if node not in SECTIONS:
        raise BadInput(f"there is no node '{node}': there are {', '.join(SECTIONS)}")
    known = _known(experiment, node)
    if name not in known:
        raise BadInput(f"{node} has no parameter '{name}': it has {', '.join(sorted(known))}")
    return known[name]


def _check_distinct(axes: Sequence[Axis]) -> None:
    seen: dict[str, list[int | None]] = {}
    for axis in axes:
        others = seen.setdefault(axis.target.parameter, [])
        if axis.target.index in others or (others and None in (axis.target.index, *others)):
            raise BadInput(f"--grid {axis.target}: there are two for {axis.target.parameter}")
        others.append(axis.target.index)


def _first_with_all(
    bare: Experiment,
    axes: Sequence[Axis],
    make: Callable[[list[str]], Experiment],
    settings: Sequence[str],
) -> Experiment:
    """The experiment with the first words that it is valid with and has all parameters with.

    Where there are none, the first ones, for what is wrong with them.
    """
    words = [axis for axis in axes if not axis.numeric and axis.target.index is None]
    if not words:
        return bare
    for axis in words:
        node, name = axis.target.node, axis.target.name
        if node not in SECTIONS:
            continue  # the loader says it
        for value in axis.choices:
            plain = list(value) if isinstance(value, tuple) else value
            known = SECTIONS[node]({**bare.nodes[node], name: plain})  # names of laws are checked
            for parameter in known:
                if parameter.name == name:
                    parameter.check(plain, node)
    combinations = product(*(axis.choices for axis in words))
    for values_ in islice(combinations, COMBINATIONS):
        own = [f"{a.target}={json.dumps(v)}" for a, v in zip(words, values_, strict=True)]
        try:
            found = make([*settings, *own])
        except BadInput:
            continue
        if all(
            axis.target.name in _known(found, axis.target.node)
            for axis in axes
            if axis.target.node in SECTIONS
        ):
            return found
    return make([*settings, *(f"{a.target}={json.dumps(a.choices[0])}" for a in words)])


def _known(experiment: Experiment, node: str) -> dict[str, Parameter]:
    return {each.name: each for each in SECTIONS[node](experiment.nodes[node])}


def _checked(axis: Axis, experiment: Experiment, lists: dict[str, tuple[float, ...]]) -> Axis:
    """The axis with the type of its parameter; its values are valid each by itself."""
    target = axis.target
    parameter = parameter_of(experiment, target.node, target.name)
    if target.index is None:
        axis = replace(axis, whole=parameter.kind == "int" and not axis.choices)
        if axis.whole:
            _check_whole(axis)
        for value in _samples(axis):
            parameter.check(list(value) if isinstance(value, tuple) else value, target.node)
        return axis
    whole = lists.get(target.parameter) or _list_of(experiment, axis, parameter)
    if target.index >= len(whole):
        raise BadInput(f"--grid {target}: {target.parameter} has {len(whole)} elements, from [0]")
    for value in _samples(axis):
        given = [*whole[: target.index], value, *whole[target.index + 1 :]]
        parameter.check(given, target.node)
    lists[target.parameter] = whole
    return axis


def _list_of(experiment: Experiment, axis: Axis, parameter: Parameter) -> tuple[float, ...]:
    if parameter.kind != "floats":
        raise BadInput(f"--grid {axis.target}: {axis.target.parameter} is no list of numbers")
    given = cast("Sequence[float]", experiment.nodes[axis.target.node][parameter.name])
    if not given and parameter.name in PER_COORDINATE:
        return (0.0,) * len(experiment.loop().plant.coordinates)
    return tuple(float(value) for value in given)


def _check_whole(axis: Axis) -> None:
    ends = (axis.start, axis.stop)
    steps = values(replace(axis, whole=False)) if axis.count else ends
    for value in (*ends, *steps):
        if float(cast("float", value)) != round(cast("float", value)):
            raise BadInput(f"--grid {axis.target}: {value} is not valid, it takes an integer")


def _samples(axis: Axis) -> Sequence[Value]:
    if axis.choices:
        return axis.choices
    ends = (axis.start, axis.stop)
    return values(axis) or (tuple(map(int, ends)) if axis.whole else ends)


def _digest(experiment: Experiment) -> str:
    text = json.dumps(experiment.nodes, sort_keys=True, default=list)
    return hashlib.sha256(text.encode()).hexdigest()[:16]
