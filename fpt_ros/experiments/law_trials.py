"""Sample arguments for each law of a loop: at the initial motion, and a little beside it."""

from collections.abc import Iterator

from fpt_ros.compensators import Observed
from fpt_ros.cycle.stages import Loop
from fpt_ros.experiments.law_trial import Point, Trial, keep, out, read, split
from fpt_ros.experiments.plant_trials import plant_trials
from fpt_ros.parameters import word
from fpt_ros.tuning import Seen


def laws_of(loop: Loop) -> tuple[object, ...]:
    """What tells one combination of laws, and the lengths of their vectors, from others."""
    plant, tuner, deformer = loop.plant.plant, loop.tuner, loop.deformer
    return (
        plant.response,
        plant.advance,
        plant.start,
        loop.plant.disturbance.force,
        loop.plant.integrator.over,
        loop.plant.suffered.laws,
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
    yield from plant_trials(loop, points)
    yield from _of_filter(loop, points)
    yield from _of_trajectory(loop)
    yield from _of_tuner(loop, points)
    yield from _of_deformer(loop, points)


def _points(loop: Loop) -> list[Point]:
    memory = loop.plant.memory
    q, v = list(memory.position), list(memory.velocity)
    beside = [x + 0.1 * (i + 1) for i, x in enumerate(q)]
    return [(q, v), (beside, [x + 0.2 * (i + 1) for i, x in enumerate(v)])]


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
        split("constants state q v"),
        lambda: [
            (*read("constants", c), keep("state", [0.0] * size), *read("q v", q, v))
            for q, v in points
        ],
    )
    yield Trial(
        f"{name} update",
        filtering.update,
        split("constants state dt q v out_q out_v out_response"),
        lambda: [
            (
                *read("constants", c),
                keep("state", begun(*points[0])),
                dt,
                *read("q v", q, v),
                *(out(each, n) for each in ("out_q", "out_v", "out_response")),
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
        split("constants state t dt out_q out_v out_a"),
        lambda: [
            (
                *read("constants", constants.nominal),
                keep("state", motion.state),
                t,
                t,
                *(out(each, c) for each in ("out_q", "out_v", "out_a")),
            )
            for t in (0.0, dt)
        ],
    )
    yield Trial(
        f"trajectory_generator.error_relaxation {word(stage.values, 'error_relaxation')}: "
        "prescribe",
        stage.relaxation.prescribe,
        split("constants nominal e e_dot e_integral"),
        lambda: [(*read("constants", constants.relaxation), 1.0, 0.1, 0.2, 0.01)],
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
            split("coefficients q v w a out"),
            lambda: [
                (
                    *read("coefficients q v w a", constants.model, q, v, v, a),
                    out("out", rows * size),
                )
                for q, v in points
            ],
        )
    fields = "seen.Y seen.error seen.tracking seen.h seen.r"
    yield Trial(
        f"parameter_tuner.method {method}: update",
        law.update,
        split("constants memory dt values seen"),
        lambda: [
            (
                *read("constants", constants.law),
                keep("memory", [0.0] * len(memory.law)),
                loop.plant.dt,
                keep("values", memory.values),
                Seen(*read(fields, [0.2] * (rows * size), [0.1] * rows, [*h, *h, *h], h, a)),
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
        split("constants r h f desired out"),
        lambda: [
            (
                *read("constants r h f desired", constants.transformation, r, h, f, desired),
                out("out", c),
            )
        ],
    )
    yield Trial(
        f"fpt_deformer.model {word(stage.values, 'model')}: effort",
        stage.model.effort,
        split("coefficients q v r s out"),
        lambda: [
            (
                *read("coefficients q v r s", constants.coefficients, q, v, asked, zeros),
                out("out", n),
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
        split("constants memory dt observed out"),
        lambda: [
            (
                *read("constants", constants.compensator),
                keep("memory", [0.0] * len(stage.memory.compensator)),
                loop.plant.dt,
                Observed(*read(fields, q, v, seen, seen, zeros, asked, asked, zeros)),
                keep("out", [0.5] * n),
            )
            for (q, v), seen in zip(points, (nan, zeros), strict=True)
        ],
    )
