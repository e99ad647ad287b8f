"""Adaptive receding horizon control (Khan, Szeghegyi and Tar 2017): the motion of a wrong model.

An optimal controller plans with the model that there is, horizon after horizon
(:mod:`fpt_ros.trajectories.horizon`). The efforts that it finds would not move the exact plant so,
and are thrown away; the motion that they would cause is what the loop makes the plant follow.

The reference is ``amplitude sin(frequency t)``. The plan is made once, before the first cycle, and
begins each horizon where the model's own motion is: the plant is taken to follow. Its points are
joined by a spline of degree 5 (:mod:`fpt_ros.trajectories.quintic_pieces`).
"""

import math
from dataclasses import replace
from functools import lru_cache

from fpt_ros.errors import BadInput
from fpt_ros.laws import Vector
from fpt_ros.parameters import Parameter, Values, integer, number, numbers, word
from fpt_ros.plants import PLANTS, Plant
from fpt_ros.trajectories import Trajectory, per_coordinate, scales
from fpt_ros.trajectories.horizon import Horizon, planned
from fpt_ros.trajectories.quintic_pieces import constants_of, nominal

STRUCTURE = (
    Parameter("horizon.model", "whose equations are optimised: a plant by its name", kind="str"),
    Parameter("horizon.parameters", "its parameters, in the plant's order", kind="floats"),
    Parameter("horizon.steps", "steps of a horizon", 20, minimum=2, maximum=200),
    Parameter("horizon.step", "length of a step", 0.05, unit="s", above=0.0),
    Parameter("horizon.applied", "steps that are taken of a horizon", 5, minimum=1),
    Parameter("horizon.effort_weight", "cost of the squared effort", 1e-3, above=0.0),
    Parameter("horizon.effort_limit", "largest effort planned; 0: none", 0.0, minimum=0.0),
    Parameter("horizon.until", "up to when it plans", 10.0, unit="s", above=0.0),
    Parameter("start", "positions at the start; empty: zero", []),
)

PARAMETERS = tuple(replace(each, live=False) for each in STRUCTURE)
"""A plan takes a second: none of them changes while the loop runs."""

MOST = 4000
"""Steps of all horizons together."""


def prepare(values: Values, c: int) -> tuple[float, ...]:
    """Constants of the pieces of the plan.

    Raises:
        BadInput: a plant that cannot be planned with, other numbers of parameters or steps.
    """
    steps, applied = integer(values, "horizon.steps"), integer(values, "horizon.applied")
    step, until = number(values, "horizon.step"), number(values, "horizon.until")
    if applied > steps:
        raise BadInput(
            f"trajectory_generator.horizon.applied: {applied} is not valid, of a horizon of "
            f"{steps} steps it takes at most {steps}"
        )
    if until / step > MOST:
        raise BadInput(
            f"trajectory_generator.horizon.until: {until / step:.0f} steps of {step:g} s, it takes "
            f"{MOST:,} at most"
        )
    limit = number(values, "horizon.effort_limit") or math.inf
    horizon = Horizon(steps, step, applied, number(values, "horizon.effort_weight"), limit)
    given = tuple(numbers(values, "horizon.parameters"))
    start = tuple(per_coordinate(values, "start", c))
    times, points = plan(
        word(values, "horizon.model"), given, horizon, scales(values, c), start, until
    )
    return constants_of((1.0,) * (2 * c), False, times, points)


def plant_of(name: str, given: Vector, c: int) -> Plant:
    """The plant to plan with.

    Raises:
        BadInput: it does not answer with accelerations of c coordinates, or has other parameters.
    """
    plant = PLANTS[name]
    if not isinstance(plant, Plant) or plant.response is None or plant.order != 2:
        raise BadInput(
            f"trajectory_generator.horizon.model: {name} has no accelerations to plan with"
        )
    if len(plant.coordinates) != c:
        raise BadInput(
            f"trajectory_generator.horizon.model: {name} has {len(plant.coordinates)} coordinates, "
            f"{c} are controlled: it takes a plant whose coordinates all are"
        )
    wanted = [parameter.name for parameter in plant.parameters]
    if len(given) != len(wanted):
        raise BadInput(
            f"trajectory_generator.horizon.parameters: {len(given)} given, {name} takes "
            f"{len(wanted)} ({', '.join(wanted)})"
        )
    return plant


@lru_cache(maxsize=16)
def plan(
    name: str,
    given: tuple[float, ...],
    horizon: Horizon,
    scale: tuple[float, ...],
    start: tuple[float, ...],
    until: float,
) -> tuple[tuple[float, ...], tuple[tuple[float, ...], ...]]:
    """Times and, by coordinate, points; kept, as a motion is prepared more than once."""
    c = len(start)
    plant = plant_of(name, given, c)
    response, coefficients = plant.response, plant.coefficients(given)
    assert response is not None

    def acceleration(q: list[float], v: list[float], u: list[float]) -> list[float]:
        out = [0.0] * c
        response(coefficients, q, v, u, out)
        return out

    def reference(t: float) -> list[float]:
        return [scale[i] * math.sin(scale[c + i] * t) for i in range(c)]

    times, points, _ = planned(horizon, acceleration, reference, list(start), until)
    return tuple(times), tuple(zip(*points, strict=True))


RECEDING_HORIZON = Trajectory(prepare, nominal, PARAMETERS)
