"""How the exact plant answers the approximate model: the response map, and its Jacobian.

Asked for r, the plant answers f(r): the exact response to the approximate model's effort for r. For
an arm J = df/dr is M^-1 M^, the inverse of the true inertia times that of the model.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

from fpt_ros.cycle.stages import Loop
from fpt_ros.cycle.trajectory_generator import slot
from fpt_ros.errors import BadInput
from fpt_ros.experiments import nominal
from fpt_ros.laws import NOT_CONTROLLED

POINTS = 200
"""Points along the motion at which the response is linearised."""


@dataclass(frozen=True)
class Point:
    """Where the response is linearised.

    Attributes:
        time: [s].
        q, v: of all n coordinates.
        r: response asked for; NaN where a coordinate is not controlled.
        coefficients: of the approximate model.
    """

    time: float
    q: list[float]
    v: list[float]
    r: list[float]
    coefficients: Sequence[float]


def nominal_points(loop: Loop) -> list[Point]:
    """The nominal motion at ``POINTS`` times."""
    plant, trajectory, dt = loop.plant, loop.trajectory, loop.plant.dt
    stride = max(1, plant.cycles // POINTS)
    every = 1 if trajectory.trajectory.state else stride  # what is integrated needs every cycle
    cycles = range(0, plant.cycles, every)
    motions = nominal.sample(trajectory, [cycle * dt for cycle in cycles], every * dt)
    n, where = len(plant.coordinates), trajectory.locate(plant.coordinates)
    points = []
    for cycle, (q_n, v_n, r_n) in list(zip(cycles, motions, strict=True))[:: stride // every]:
        q, v = list(plant.memory.position), list(plant.memory.velocity)
        r = [NOT_CONTROLLED] * n
        active = slot(trajectory.constants.slots, float(cycle * plant.cycle_time))
        for i, at in enumerate(where):
            q[at], v[at] = q_n[i], v_n[i]
            if active in (-1, i):
                r[at] = r_n[i]
        points.append(Point(cycle * dt, q, v, r, loop.deformer.coefficients))
    return points


def jacobian(loop: Loop, point: Point) -> list[list[float]]:
    """J = df/dr over the coordinates that are controlled at a point, by central differences."""
    where = [
        at for at in loop.trajectory.locate(loop.plant.coordinates) if not math.isnan(point.r[at])
    ]
    J = [[math.nan] * len(where) for _ in where]
    try:
        for j, at in enumerate(where):
            step = 1e-3 * (1.0 + abs(point.r[at]))
            up, down = list(point.r), list(point.r)
            up[at] += step
            down[at] -= step
            high, low = response(loop, point, up), response(loop, point, down)
            for i, row in enumerate(where):
                J[i][j] = (high[row] - low[row]) / (2.0 * step)
    except (ArithmeticError, ValueError):
        pass
    return J


def response(loop: Loop, point: Point, r: list[float]) -> list[float]:
    """f(r): the exact plant's response to the approximate model's effort for r."""
    n = len(point.q)
    effort, out = [0.0] * n, [0.0] * n
    loop.deformer.model.effort(point.coefficients, point.q, point.v, r, [0.0] * n, effort)
    if loop.plant.plant.response is None:
        raise BadInput(f"the plant {loop.plant.values['plant']} has no response to linearise")
    loop.plant.plant.response(loop.plant.coefficients, point.q, point.v, effort, out)
    return out


def mean_diagonal(loop: Loop) -> list[float]:
    """The mean diagonal of J along the nominal motion, of each controlled coordinate.

    Raises:
        BadInput: the response is not defined anywhere along it, or grows against what is asked for.
    """
    controlled = loop.trajectory.locate(loop.plant.coordinates)
    known: list[list[float]] = [[] for _ in controlled]
    for point in nominal_points(loop):
        there = [i for i, at in enumerate(controlled) if not math.isnan(point.r[at])]
        for i, row in enumerate(jacobian(loop, point)):
            if math.isfinite(row[i]):
                known[there[i]].append(row[i])
    means = [sum(found) / len(found) if found else math.nan for found in known]
    for name, mean in zip(loop.trajectory.controlled, means, strict=True):
        if not mean > 0.0:
            raise BadInput(
                f"fpt_deformer.weights: auto needs a response that follows what is asked for, that "
                f"of '{name}' does not (mean diagonal of the response map {mean:g})"
            )
    return means
