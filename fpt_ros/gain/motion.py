"""The spectrum of the response map along a motion, nominal or run."""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from fpt_ros.cycle.stages import Loop
from fpt_ros.engine.engine import Engine
from fpt_ros.experiments.experiment import Experiment
from fpt_ros.experiments.response_map import POINTS, Point, jacobian, nominal_points
from fpt_ros.runs.run import Array


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
        J = np.array(jacobian(loop, point))
        if np.isfinite(J).all():
            where = [at for at in controlled if not math.isnan(point.r[at])]
            found = np.linalg.eigvals(np.array([[weights[at]] for at in where]) * J)
            row[: len(found)] = np.sort_complex(found)
        rows.append(row)
    return np.array(rows).reshape(len(rows), len(controlled))
