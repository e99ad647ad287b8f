"""What stages 1 and 6 compute: what the sensors show, and the motion that an effort causes."""

import math
from collections.abc import Callable
from enum import IntEnum
from functools import cache
from typing import NamedTuple

from fpt_ros.cycle.rows import JointStatesRow
from fpt_ros.disturbances import Force
from fpt_ros.laws import Matrix, MutableVector, Vector, helper
from fpt_ros.plants import Advance, Response


class PlantConstants(NamedTuple):
    """Fixed.

    ``coefficients`` of the exact plant; constants of the ``disturbance``, which acts on the
    coordinate number ``disturbed``; limits beyond which the run is lost; standard deviations
    ``sigma_q``, ``sigma_v`` of the noise; ``h``: length of one of the ``substeps`` [s]; ``order``
    of the response; ``velocity_measured``; ``late``: cycles by which the sensors are.
    """

    coefficients: Vector
    disturbance: Vector
    position_limit: Vector
    acceleration_limit: float
    sigma_q: float
    sigma_v: float
    h: float
    substeps: int
    order: int
    disturbed: int
    velocity_measured: int
    late: int


class PlantMemory(NamedTuple):
    """Motion and the effort that acted last (n each), and what disturbance and plant remember.

    ``past``: ring of the last motions, q and v in a row, for sensors that are late.
    """

    position: MutableVector
    velocity: MutableVector
    effort: MutableVector
    disturbance: MutableVector
    own: MutableVector
    past: Matrix


class PlantWork(NamedTuple):
    """n each; ``place``: the coordinate that went wrong, one number."""

    position: MutableVector
    velocity: MutableVector
    acting: MutableVector
    external: MutableVector
    response: MutableVector
    place: MutableVector


class Fault(IntEnum):
    """What went wrong in a cycle."""

    NONE = 0
    EFFORT = 1
    RESPONSE = 2
    POSITION = 3


NONE, EFFORT, RESPONSE, POSITION = map(int, Fault)

Step = Callable[[PlantConstants, PlantMemory, PlantWork, float, Vector], int]
"""(constants, memory, work, t, effort) -> fault: one cycle of the plant with the effort held.

The memory stays as it is where something is wrong, but for the disturbance's and the plant's own.
"""


@helper
def measure(
    constants: PlantConstants,
    memory: PlantMemory,
    cycle: int,
    noise: Vector,
    out: JointStatesRow,
) -> None:
    """Motion with noise (2 n unit normal numbers, or none), NaN where no velocity is measured."""
    q, v, past, late = out.position, out.velocity, memory.past, constants.late
    n = len(q)
    for i in range(n):
        q[i], v[i], out.effort[i] = memory.position[i], memory.velocity[i], memory.effort[i]
        if late > 0:
            now, then = cycle % (late + 1), (cycle + 1) % (late + 1)
            past[now, i], past[now, n + i] = q[i], v[i]
            q[i], v[i] = past[then, i], past[then, n + i]
        if len(noise) > 0:
            q[i] += constants.sigma_q * noise[i]
            v[i] += constants.sigma_v * noise[n + i]
        if not constants.velocity_measured:
            v[i] = math.nan


@cache
def explicit_euler(response: Response, force: Force) -> Step:
    """The step of a plant that gives its response: explicit Euler, ``substeps`` of h [s]."""

    def step(
        constants: PlantConstants, memory: PlantMemory, work: PlantWork, t: float, effort: Vector
    ) -> int:
        q, v, a, acting = work.position, work.velocity, work.response, work.acting
        h, hit, order = constants.h, constants.disturbed, constants.order
        n = len(q)
        for i in range(n):
            q[i], v[i] = memory.position[i], memory.velocity[i]
            if not math.isfinite(effort[i]):
                work.place[0] = i
                return EFFORT
        for substep in range(constants.substeps):
            for i in range(n):
                acting[i] = effort[i]
            acting[hit] += force(
                constants.disturbance, memory.disturbance, t + substep * h, h, q[hit], v[hit]
            )
            response(constants.coefficients, q, v, acting, a)
            for i in range(n):
                if not abs(a[i]) <= constants.acceleration_limit:
                    work.place[0] = i
                    return RESPONSE
                if order == 2:
                    q[i] += h * v[i]
                    v[i] += h * a[i]
                elif order == 1:
                    q[i] += h * a[i]
                    v[i] = a[i]
                else:
                    q[i] = a[i]
                if not abs(q[i]) <= constants.position_limit[i]:
                    work.place[0] = i
                    return POSITION
        for i in range(n):
            memory.position[i], memory.velocity[i], memory.effort[i] = q[i], v[i], effort[i]
        return NONE

    return step


@cache
def by_itself(advance: Advance, force: Force) -> Step:
    """The step of a plant that integrates itself; the acceleration is the velocity's difference."""

    def step(
        constants: PlantConstants, memory: PlantMemory, work: PlantWork, t: float, effort: Vector
    ) -> int:
        q, v, a, acted = work.position, work.velocity, work.response, work.acting
        external, h, hit = work.external, constants.h, constants.disturbed
        n = len(q)
        for i in range(n):
            q[i], v[i], external[i] = memory.position[i], memory.velocity[i], 0.0
            if not math.isfinite(effort[i]):
                work.place[0] = i
                return EFFORT
        for substep in range(constants.substeps):
            for i in range(n):
                a[i] = v[i]
            at = t + substep * h
            external[hit] = force(constants.disturbance, memory.disturbance, at, h, q[hit], v[hit])
            advance(constants.coefficients, memory.own, at, h, effort, external, q, v, acted)
            for i in range(n):
                a[i] = (v[i] - a[i]) / h
                if not abs(a[i]) <= constants.acceleration_limit:
                    work.place[0] = i
                    return RESPONSE
                if not abs(q[i]) <= constants.position_limit[i]:
                    work.place[0] = i
                    return POSITION
        for i in range(n):
            memory.position[i], memory.velocity[i], memory.effort[i] = q[i], v[i], acted[i]
        return NONE

    return step
