"""Sample arguments for the laws of the plant, its sensors and its actuators."""

from collections.abc import Iterator
from functools import partial
from typing import Any

from fpt_ros.cycle.stages import Loop
from fpt_ros.experiments.law_trial import Point, Trial, keep, out, read, split
from fpt_ros.laws import Indices, Vector
from fpt_ros.parameters import word


def plant_trials(loop: Loop, points: list[Point]) -> Iterator[Trial]:
    """All of them, at some points of the motion."""
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

    yield from _of_suffered(loop, points)
    if plant.response is not None:
        yield Trial(
            f"{name} response",
            plant.response,
            split("coefficients q v effort out"),
            lambda: [
                (*read("coefficients q v effort", c, q, v, effort), out("out", n))
                for q, v in points
            ],
        )
    if plant.start is not None:
        yield Trial(
            f"{name} start",
            plant.start,
            split("coefficients state q v"),
            lambda: [
                (
                    *read("coefficients", c),
                    keep("state", [0.0] * plant.state),
                    *read("q v", q, v),
                )
                for q, v in points
            ],
        )
    if plant.advance is not None:
        yield Trial(
            f"{name} advance",
            plant.advance,
            split("coefficients state t dt effort external q v acted"),
            lambda: [
                (
                    *read("coefficients", c),
                    keep("state", state_at(q, v)),
                    0.0,
                    h,
                    *read("effort external", effort, [0.0] * n),
                    keep("q", q),
                    keep("v", v),
                    out("acted", n),
                )
                for q, v in points
            ],
        )
    yield from _of_integrator(loop, points)
    yield Trial(
        f"plant_simulator.disturbance.kind {kind}: force",
        force,
        split("constants state t h q v"),
        lambda: [
            (
                *read("constants", acts),
                keep("state", [0.0] * stage.disturbance.state),
                0.0,
                h,
                q[stage.constants.disturbed],
                v[stage.constants.disturbed],
            )
            for q, v in points
        ],
        gives_number=True,
    )


def _of_suffered(loop: Loop, points: list[Point]) -> Iterator[Trial]:
    """The disturbances of sensors and actuators."""
    suffered, dt, n = loop.plant.suffered, loop.plant.dt, len(loop.plant.coordinates)
    for at, (name, sensor) in enumerate(suffered.sensors.items()):
        constants, state = suffered.sensor_constants[at], sensor.state(n)
        q, v = points[-1]
        yield Trial(
            f"plant_simulator.sensors.kinds {name}: spoil",
            sensor.spoil,
            split("constants state dt where q v"),
            partial(_sensor_call, constants, state, dt, suffered.sensors_at, q, v),
        )
    for at, (name, actuator) in enumerate(suffered.actuators.items()):
        constants, state = suffered.actuator_constants[at], actuator.state(n)
        yield Trial(
            f"plant_simulator.actuators.kinds {name}: actuate",
            actuator.actuate,
            split("constants state dt where effort"),
            partial(_actuator_call, constants, state, dt, suffered.actuators_at, [0.5] * n),
        )


def _sensor_call(
    constants: Vector, state: int, dt: float, where: Indices, q: Vector, v: Vector
) -> list[tuple[Any, ...]]:
    begun = keep("state", [0.0] * state)
    return [(*read("constants", constants), begun, dt, where, keep("q", q), keep("v", v))]


def _actuator_call(
    constants: Vector, state: int, dt: float, where: Indices, effort: Vector
) -> list[tuple[Any, ...]]:
    begun = keep("state", [0.0] * state)
    return [(*read("constants", constants), begun, dt, where, keep("effort", effort))]


def _of_integrator(loop: Loop, points: list[Point]) -> Iterator[Trial]:
    stage, n = loop.plant, len(loop.plant.coordinates)
    if stage.plant.response is None or stage.plant.advance is not None:
        return
    yield Trial(
        f"plant_simulator.integrator.kind {word(stage.values, 'integrator.kind')}: integrate",
        stage.integrator.over(stage.plant.response),
        split("constants order h coefficients effort q v a work"),
        lambda: [
            (
                *read("constants", stage.constants.integrator),
                stage.plant.order,
                stage.constants.h,
                *read("coefficients effort", stage.coefficients, [0.5] * n),
                keep("q", q),
                keep("v", v),
                out("a", n),
                keep("work", [0.0] * (stage.integrator.vectors * n)),
            )
            for q, v in points
        ],
    )
