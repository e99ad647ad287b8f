"""What of a controller is tuned: the numbers of its laws, found by themselves."""

from collections.abc import Iterator, Sequence
from typing import cast

from fpt_ros.compare.measures import simulate
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.experiments.sections import SECTIONS
from fpt_ros.sweep.grid import Space, Target, parse
from fpt_ros.sweep.job import Job
from fpt_ros.sweep.tune import Task
from fpt_ros.sweep.tuned_parameter import TunedParameter
from fpt_ros.transformations import TRANSFORMATIONS

WIDTH = 10.0
"""A parameter is searched from a tenth of what it is to ten times that."""

FASTER = 4.0
"""The rate at which errors decay, lambda, is searched up to so many times what it is."""

SHAPE = ("K", "B", "D", "a")
"""Of a transformation: what its gain or scale stands for as well, left as it is."""

ERROR, STEP = "whole.error", "whole.step"
"""What shall be small, and what is limited."""


def tuned_parameters(
    experiment: Experiment, hold: Sequence[str] = ()
) -> tuple[TunedParameter, ...]:
    """Gain and scale of the transformation, numbers of compensator and tuner, lambda, and the
    bandwidth of the filter: those that are not zero, and are not held.
    """
    return tuple(each for each in _found(experiment) if each.target.parameter not in hold)


def _found(experiment: Experiment) -> Iterator[TunedParameter]:
    nodes = experiment.nodes
    generator, deformer = nodes["trajectory_generator"], nodes["fpt_deformer"]
    rate = cast("float", generator["lambda"])
    where = Target("trajectory_generator", "lambda")
    yield TunedParameter(where, rate / WIDTH, rate * FASTER, rate, whole=False)
    kind = TRANSFORMATIONS[str(deformer["transformation"])]
    own = {each.name for each in kind.parameters} - set(SHAPE) if kind.adapts else set()
    own |= {name for name in deformer if name.startswith("compensator.")}
    yield from _all("fpt_deformer", experiment, own)
    tuner = nodes["parameter_tuner"]
    if tuner["method"] != "none":
        shared = {each.name for each in SECTIONS["parameter_tuner"]({"method": "none"})}
        yield from _all("parameter_tuner", experiment, set(tuner) - shared)
    filter_ = nodes["denoiser"]
    if filter_["method"] == "kalman_bank":
        densities = cast("list[float]", filter_["densities"])
        for at, density in enumerate(densities):
            # to the sixth power of the bandwidth: from half of it to twice
            low, high = density / 2.0**6, density * 2.0**6
            target = Target("denoiser", "densities", at)
            yield TunedParameter(target, low, high, density, whole=False)


def _all(node: str, experiment: Experiment, names: set[str]) -> Iterator[TunedParameter]:
    values = experiment.nodes[node]
    for parameter in SECTIONS[node](values):
        if parameter.name in names and parameter.kind == "float" and parameter.live:
            present = float(cast("float", values[parameter.name]))
            low, high = sorted((present / WIDTH, present * WIDTH))
            low, high = max(low, parameter.minimum), min(high, parameter.maximum)
            if low < high:
                yield TunedParameter(Target(node, parameter.name), low, high, present, whole=False)


def task_of(
    name: str,
    variant: str,
    settings: tuple[str, ...],
    duration: float | None,
    experiment: Experiment,
    limit: float,
    hold: Sequence[str],
) -> Task:
    """The search for the least error with efforts that step no more than a limit."""
    parameters = tuned_parameters(experiment, hold)
    axes = tuple(parse(f"{p.target}={p.low!r}:{p.high!r}:2") for p in parameters)
    lists = {
        p.target.parameter: tuple(
            cast("list[float]", experiment.nodes[p.target.node][p.target.name])
        )
        for p in parameters
        if p.target.index is not None
    }
    space = Space(axes)
    job = Job(name, variant, settings, duration, space, tuple(lists.items()), ())
    return Task(job, parameters, (ERROR,), {STEP: limit}, simulate)
