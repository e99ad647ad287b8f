"""How the exact plant answers the approximate model along a motion: the response's Jacobian."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from fpt_ros.cycle.stages import Loop
from fpt_ros.cycle.trajectory_generator import slot
from fpt_ros.engine.engine import Engine
from fpt_ros.errors import BadInput
from fpt_ros.experiments import nominal
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.laws import NOT_CONTROLLED
from fpt_ros.runs.run import Array

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


@dataclass(frozen=True)
class Course:
    """Eigenvalues along a motion.

    Attributes:
        time: (N,) [s].
        eigenvalues: (N, c) of W J, real parts, sorted; NaN where there are fewer.
    """

    time: Array
    eigenvalues: Array


def course(experiment: Experiment, points: Sequence[Point] | None = None) -> Course:
    """The eigenvalues along a motion, the nominal one by default."""
    loop = experiment.loop()
    points = nominal_points(loop) if points is None else points
    return Course(np.array([point.time for point in points]), spectrum(loop, points).real)


def feedback(loop: Loop) -> float:
    """How much of the response error the desired response takes back within the learning delay."""
    relaxation = loop.trajectory.relaxation
    relax = partial(relaxation.prescribe, loop.trajectory.constants.relaxation, 0.0)
    changed = {0: (0.0, 0.0), 1: (1.0, 0.0), 2: (0.0, 1.0)}[relaxation.order]
    rate = relax(*changed, 0.0) - relax(0.0, 0.0, 0.0)
    return rate * loop.plant.dt * max(loop.deformer.delay, loop.deformer.hold)


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


def along(engine: Engine, loop: Loop) -> list[Point]:
    """The motion of a run at ``POINTS`` times, with the model as it was tuned then."""
    topics = engine.topics()
    state, command = topics["state_estimate"], topics["command"]
    tuned, names = topics.get("tuning"), loop.deformer.model.coefficient_names
    follows = tuned is not None and names and tuned.names[: len(names)] == names
    rest = loop.deformer.coefficients[len(names) :]
    points = []
    for k in range(0, engine.done, max(1, engine.done // POINTS)):
        coefficients: Sequence[float] = loop.deformer.coefficients
        if tuned is not None and follows:
            coefficients = [*tuned.vectors["values"][k, : len(names)].tolist(), *rest]
        points.append(
            Point(
                float(state.time[k]),
                state.vectors["positions"][k].tolist(),
                state.vectors["velocities"][k].tolist(),
                command.vectors["accelerations"][k].tolist(),
                coefficients,
            )
        )
    return points


def spectrum(loop: Loop, points: Iterable[Point]) -> NDArray[np.complex128]:
    """Eigenvalues of W J, a row a point, sorted; NaN where it has fewer, or is not defined."""
    controlled = loop.trajectory.locate(loop.plant.coordinates)
    weights = dict(
        zip(controlled, loop.deformer.weights_of(loop.trajectory.controlled), strict=True)
    )
    rows = []
    for point in points:
        row = np.full(len(controlled), complex(math.nan, math.nan))
        J = jacobian(loop, point)
        if np.isfinite(J).all():
            where = [at for at in controlled if not math.isnan(point.r[at])]
            found = np.linalg.eigvals(np.array([[weights[at]] for at in where]) * J)
            row[: len(found)] = np.sort_complex(found)
        rows.append(row)
    return np.array(rows).reshape(len(rows), len(controlled))


def jacobian(loop: Loop, point: Point) -> Array:
    """J = df/dr over the coordinates that are controlled at a point, by central differences."""
    where = [
        at for at in loop.trajectory.locate(loop.plant.coordinates) if not math.isnan(point.r[at])
    ]
    J = np.full((len(where), len(where)), math.nan)
    try:
        for j, at in enumerate(where):
            step = 1e-3 * (1.0 + abs(point.r[at]))
            up, down = list(point.r), list(point.r)
            up[at] += step
            down[at] -= step
            high, low = response(loop, point, up), response(loop, point, down)
            for i, row in enumerate(where):
                J[i, j] = (high[row] - low[row]) / (2.0 * step)
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
