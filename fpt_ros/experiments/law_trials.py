"""Sample arguments for each law of a loop: at the initial motion, and a little beside it."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

from fpt_ros.compensators import Observed
from fpt_ros.cycle.stages import Loop
from fpt_ros.experiments.watched import Watched
from fpt_ros.parameters import word
from fpt_ros.tuning import Seen

READ, KEEP, OUT = "read", "keep", "out"

Point = tuple[list[float], list[float]]
"""Position and velocity of all coordinates."""


@dataclass(frozen=True)
class Trial:
    """A law to be tried.

    Attributes:
        name: what messages call it: the parameter that chose it, its name, what it computes.
        law: the function.
        takes: names of its arguments, as its kind has them.
        calls: fresh arguments for each call.
        gives_number: it returns a number; others return nothing.
    """

    name: str
    law: Callable[..., Any]
    takes: tuple[str, ...]
    calls: Callable[[], list[tuple[Any, ...]]]
    gives_number: bool = False

    def written(self) -> list[str]:
        """Names of what it writes its results into."""
        outs = [name for name in self.takes if name.startswith("out") or name == "acted"]
        return outs or ["values"]


def laws_of(loop: Loop) -> tuple[object, ...]:
    """What tells one combination of laws, and the lengths of their vectors, from others."""
    plant, tuner, deformer = loop.plant.plant, loop.tuner, loop.deformer
    return (
        plant.response,
        plant.advance,
        plant.start,
        loop.plant.disturbance.force,
        loop.denoiser.filter.start,
        loop.denoiser.filter.update,
        loop.trajectory.trajectory.nominal,
        loop.trajectory.relaxation.prescribe,
        tuner.law.update,
        tuner.regressor,
        deformer.transformation.deform,
        deformer.model.effort,
        deformer.compensator.compensate,
        loop.trajectory.controlled,
        deformer.controlled,
        *(stage.layout.size for stage in loop.stages() if stage.layout is not None),
    )


def trials(loop: Loop) -> Iterator[Trial]:
    """All laws of a loop, in the order of events."""
    points = _points(loop)
    yield from _of_plant(loop, points)
    yield from _of_filter(loop, points)
    yield from _of_trajectory(loop)
    yield from _of_tuner(loop, points)
    yield from _of_deformer(loop, points)


def _points(loop: Loop) -> list[Point]:
    memory = loop.plant.memory
    q, v = list(memory.position), list(memory.velocity)
    beside = [x + 0.1 * (i + 1) for i, x in enumerate(q)]
    return [(q, v), (beside, [x + 0.2 * (i + 1) for i, x in enumerate(v)])]


def _read(names: str, *vectors: Sequence[float]) -> tuple[Watched, ...]:
    return tuple(Watched(n, x, READ) for n, x in zip(names.split(), vectors, strict=True))


def _keep(name: str, values: Sequence[float]) -> Watched:
    return Watched(name, values, KEEP)


def _out(name: str, size: int) -> Watched:
    return Watched(name, [0.0] * size, OUT)


def _split(names: str) -> tuple[str, ...]:
    return tuple(names.split())


def _of_plant(loop: Loop, points: list[Point]) -> Iterator[Trial]:
    stage, plant, n = loop.plant, loop.plant.plant, len(loop.plant.coordinates)
    c, h, effort = stage.coefficients, stage.constants.h, [0.5] * n
    name = f"plant_simulator.plant {word(stage.values, 'plant')}:"
    force, acts = stage.disturbance.force, list(stage.constants.disturbance)
    kind = word(stage.values, "disturbance.kind")

    def state_at(q: list[float], v: list[float]) -> list[float]:
        state = list(stage.memory.own)
        if plant.start is not None:
            plant.start(c, state, q, v)
        return state

    if plant.response is not None:
        yield Trial(
            f"{name} response",
            plant.response,
            _split("coefficients q v effort out"),
            lambda: [
                (*_read("coefficients q v effort", c, q, v, effort), _out("out", n))
                for q, v in points
            ],
        )
    if plant.start is not None:
        yield Trial(
            f"{name} start",
            plant.start,
            _split("coefficients state q v"),
            lambda: [
                (
                    *_read("coefficients", c),
                    _keep("state", [0.0] * plant.state),
                    *_read("q v", q, v),
                )
                for q, v in points
            ],
        )
    if plant.advance is not None:
        yield Trial(
            f"{name} advance",
            plant.advance,
            _split("coefficients state t dt effort external q v acted"),
            lambda: [
                (
                    *_read("coefficients", c),
                    _keep("state", state_at(q, v)),
                    0.0,
                    h,
                    *_read("effort external", effort, [0.0] * n),
                    _keep("q", q),
                    _keep("v", v),
                    _out("acted", n),
                )
                for q, v in points
            ],
        )
    yield Trial(
        f"plant_simulator.disturbance.kind {kind}: force",
        force,
        _split("constants state t h q v"),
        lambda: [
            (
                *_read("constants", acts),
                _keep("state", [0.0] * stage.disturbance.state),
                0.0,
                h,
                q[stage.constants.disturbed],
                v[stage.constants.disturbed],
            )
            for q, v in points
        ],
        gives_number=True,
    )


def _of_filter(loop: Loop, points: list[Point]) -> Iterator[Trial]:
    stage, n, dt = loop.denoiser, len(loop.plant.coordinates), loop.plant.dt
    if not stage.sized:
        return
    c, size, filtering = stage.constants.filter, len(stage.memory.filter), stage.filter
    name = f"denoiser.method {word(stage.values, 'method')}:"

    def begun(q: list[float], v: list[float]) -> list[float]:
        state = [0.0] * size
        filtering.start(c, state, q, v)
        return state

    yield Trial(
        f"{name} start",
        filtering.start,
        _split("constants state q v"),
        lambda: [
            (*_read("constants", c), _keep("state", [0.0] * size), *_read("q v", q, v))
            for q, v in points
        ],
    )
    yield Trial(
        f"{name} update",
        filtering.update,
        _split("constants state dt q v out_q out_v out_response"),
        lambda: [
            (
                *_read("constants", c),
                _keep("state", begun(*points[0])),
                dt,
                *_read("q v", q, v),
                *(_out(each, n) for each in ("out_q", "out_v", "out_response")),
            )
            for q, v in points
        ],
    )


def _of_trajectory(loop: Loop) -> Iterator[Trial]:
    stage, dt, c = loop.trajectory, loop.plant.dt, len(loop.trajectory.controlled)
    constants, motion = stage.constants, stage.trajectory
    yield Trial(
        f"trajectory_generator.trajectory {word(stage.values, 'trajectory')}: nominal",
        motion.nominal,
        _split("constants state t dt out_q out_v out_a"),
        lambda: [
            (
                *_read("constants", constants.nominal),
                _keep("state", motion.state),
                t,
                t,
                *(_out(each, c) for each in ("out_q", "out_v", "out_a")),
            )
            for t in (0.0, dt)
        ],
    )
    yield Trial(
        f"trajectory_generator.error_relaxation {word(stage.values, 'error_relaxation')}: "
        "prescribe",
        stage.relaxation.prescribe,
        _split("constants nominal e e_dot e_integral"),
        lambda: [(*_read("constants", constants.relaxation), 1.0, 0.1, 0.2, 0.01)],
        gives_number=True,
    )


def _of_tuner(loop: Loop, points: list[Point]) -> Iterator[Trial]:
    stage, n, c = loop.tuner, len(loop.plant.coordinates), len(loop.trajectory.controlled)
    if not (stage.active and stage.published):
        return
    constants, memory, rows = stage.constants, stage.memory, stage.rows
    size, law, method = len(memory.values), stage.law, word(stage.values, "method")
    a, h = [0.3 * (i + 1) for i in range(n)], [0.1] * (c if law.desired else 0)
    if rows:
        yield Trial(
            f"parameter_tuner.model {word(stage.values, 'model')}: regressor",
            stage.regressor,
            _split("q v w a out"),
            lambda: [(*_read("q v w a", q, v, v, a), _out("out", rows * size)) for q, v in points],
        )
    fields = "seen.Y seen.error seen.tracking seen.h seen.r"
    yield Trial(
        f"parameter_tuner.method {method}: update",
        law.update,
        _split("constants memory dt values seen"),
        lambda: [
            (
                *_read("constants", constants.law),
                _keep("memory", [0.0] * len(memory.law)),
                loop.plant.dt,
                _keep("values", memory.values),
                Seen(*_read(fields, [0.2] * (rows * size), [0.1] * rows, [*h, *h, *h], h, a)),
            )
        ],
    )


def _of_deformer(loop: Loop, points: list[Point]) -> Iterator[Trial]:
    stage, n, c = loop.deformer, len(loop.plant.coordinates), len(loop.trajectory.controlled)
    if not stage.controlled:
        return
    constants, where = stage.constants, stage.constants.where
    desired = [0.5 * (i + 1) for i in range(c)]
    r, h, zeros = [x + 0.2 for x in desired], [0.1] * c, [0.0] * n
    f = [x + 0.1 for x in desired]
    asked = [r[where.index(i)] if i in where else float("nan") for i in range(n)]
    yield Trial(
        f"fpt_deformer.transformation {word(stage.values, 'transformation')}: deform",
        stage.transformation.deform,
        _split("constants r h f desired out"),
        lambda: [
            (
                *_read("constants r h f desired", constants.transformation, r, h, f, desired),
                _out("out", c),
            )
        ],
    )
    yield Trial(
        f"fpt_deformer.model {word(stage.values, 'model')}: effort",
        stage.model.effort,
        _split("coefficients q v r s out"),
        lambda: [
            (
                *_read("coefficients q v r s", constants.coefficients, q, v, asked, zeros),
                _out("out", n),
            )
            for q, v in points
        ],
    )
    if not constants.compensates:
        return
    fields = " ".join(f"observed.{name}" for name in Observed._fields)
    nan = [float("nan")] * n
    yield Trial(
        f"fpt_deformer.compensator.kind {word(stage.values, 'compensator.kind')}: compensate",
        stage.compensator.compensate,
        _split("constants memory dt observed out"),
        lambda: [
            (
                *_read("constants", constants.compensator),
                _keep("memory", [0.0] * len(stage.memory.compensator)),
                loop.plant.dt,
                Observed(*_read(fields, q, v, seen, seen, zeros, asked, asked, zeros)),
                _keep("out", [0.5] * n),
            )
            for (q, v), seen in zip(points, (nan, zeros), strict=True)
        ],
    )
