"""Disturbances of sensors and of actuators one after the other, all of them as one law."""

from collections.abc import Callable
from functools import cache

from fpt_ros.disturbances.actuators import Actuate
from fpt_ros.disturbances.sensors import Spoil
from fpt_ros.laws import Indices, Matrix, MutableVector

Sense = Callable[[Matrix, Matrix, float, Indices, MutableVector, MutableVector], None]
"""(constants, states, dt, where, q, v): a row of constants and of states a disturbance"""

Drive = Callable[[Matrix, Matrix, float, Indices, MutableVector], None]
"""(constants, states, dt, where, effort)"""


Spoilt = Callable[[int, Matrix, Matrix, float, Indices, MutableVector, MutableVector], None]
"""(side, constants, states, dt, where, q, v): a sense, or a drive of the efforts ``q``"""

AT_SENSORS, AT_ACTUATORS = 0, 1


def as_measured(
    constants: Matrix,
    states: Matrix,
    dt: float,
    where: Indices,
    q: MutableVector,
    v: MutableVector,
) -> None:
    """Sensors that nothing spoils."""


def as_commanded(
    constants: Matrix, states: Matrix, dt: float, where: Indices, effort: MutableVector
) -> None:
    """Actuators that do what they are told."""


@cache
def sensing(laws: tuple[Spoil, ...]) -> Sense:
    """What the laws do to a measurement, the first one first."""
    if not laws:
        return as_measured
    before, last, at = sensing(laws[:-1]), laws[-1], len(laws) - 1

    def spoil_all(
        constants: Matrix,
        states: Matrix,
        dt: float,
        where: Indices,
        q: MutableVector,
        v: MutableVector,
    ) -> None:
        before(constants, states, dt, where, q, v)
        last(constants[at], states[at], dt, where, q, v)

    return spoil_all


@cache
def driving(laws: tuple[Actuate, ...]) -> Drive:
    """What the laws do to efforts, the first one first."""
    if not laws:
        return as_commanded
    before, last, at = driving(laws[:-1]), laws[-1], len(laws) - 1

    def drive_all(
        constants: Matrix, states: Matrix, dt: float, where: Indices, effort: MutableVector
    ) -> None:
        before(constants, states, dt, where, effort)
        last(constants[at], states[at], dt, where, effort)

    return drive_all


@cache
def spoiling(sense: Sense, drive: Drive) -> Spoilt:
    """Both as one law: what a loop calls through pointers should be few."""

    def spoil(
        side: int,
        constants: Matrix,
        states: Matrix,
        dt: float,
        where: Indices,
        q: MutableVector,
        v: MutableVector,
    ) -> None:
        if side == AT_SENSORS:
            sense(constants, states, dt, where, q, v)
        else:
            drive(constants, states, dt, where, q)

    return spoil
