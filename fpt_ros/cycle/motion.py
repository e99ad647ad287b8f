"""What stages 1 and 6 compute: what the sensors show, and the motion that an effort causes."""

import math
from collections.abc import Callable
from enum import IntEnum
from functools import cache
from typing import NamedTuple

from fpt_ros.cycle.chains import Drive, Sense
from fpt_ros.cycle.rows import JointStatesRow
from fpt_ros.disturbances import Force
from fpt_ros.integrators import Integrate
from fpt_ros.laws import Indices, Matrix, MutableVector, Vector, helper
from fpt_ros.plants import Advance


class PlantConstants(NamedTuple):
    """Fixed.

    ``coefficients`` of the exact plant; constants of the ``disturbance``, which acts on the
    coordinate number ``disturbed``; limits beyond which the run is lost; standard deviations
    ``sigma_q``, ``sigma_v`` of the noise; ``h``: length of one of the ``substeps`` [s]; ``order``
    of the response; ``velocity_measured``; ``late``: cycles by which the sensors are; constants of
    the ``integrator``; of the disturbances of ``sensors`` and ``actuators``, a row each, and the
    coordinates that have them; ``dt``: length of a cycle [s].
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
    dt: float
    integrator: Vector
    sensors: Matrix
    sensors_at: Indices
    actuators: Matrix
    actuators_at: Indices


class PlantMemory(NamedTuple):
    """Motion and the effort that acted last (n each), and what disturbance and plant remember.

    ``past``: ring of the last motions, q and v in a row, for sensors that are late. ``sensors``,
    ``actuators``: what their disturbances remember, a row each.
    """

    position: MutableVector
    velocity: MutableVector
    effort: MutableVector
    disturbance: MutableVector
    own: MutableVector
    past: Matrix
    sensors: Matrix
    actuators: Matrix


class PlantWork(NamedTuple):
    """n each; ``place``: the coordinate that went wrong, one number; the ``integrator``'s.

    ``driven``: the efforts that come out of the actuators; ``acting``: with the external force.
    """

    position: MutableVector
    velocity: MutableVector
    driven: MutableVector
    acting: MutableVector
    external: MutableVector
    response: MutableVector
    place: MutableVector
    integrator: MutableVector


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
    sense: Sense,
    constants: PlantConstants,
    memory: PlantMemory,
    cycle: int,
    noise: Vector,
    out: JointStatesRow,
) -> None:
    """Motion with noise (2 n unit normal numbers, or none), NaN where no velocity is measured.

    What spoils the sensors comes last; their first sample is as it is.
    """
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
    if cycle > 0:
        sense(constants.sensors, memory.sensors, constants.dt, constants.sensors_at, q, v)


@helper
def take_effort(
    drive: Drive,
    constants: PlantConstants,
    memory: PlantMemory,
    work: PlantWork,
    effort: Vector,
) -> int:
    """The motion of the cycle's start and the efforts that come out of the actuators."""
    for i in range(len(effort)):
        work.position[i], work.velocity[i] = memory.position[i], memory.velocity[i]
        work.driven[i] = effort[i]
        if not math.isfinite(effort[i]):
            work.place[0] = i
            return EFFORT
    drive(constants.actuators, memory.actuators, constants.dt, constants.actuators_at, work.driven)
    return NONE


@helper
def fault_of(constants: PlantConstants, work: PlantWork) -> int:
    """Whether a response or a position is not finite or beyond its limit."""
    for i in range(len(work.position)):
        if not abs(work.response[i]) <= constants.acceleration_limit:
            work.place[0] = i
            return RESPONSE
        if not abs(work.position[i]) <= constants.position_limit[i]:
            work.place[0] = i
            return POSITION
    return NONE


@cache
def integrated(integrate: Integrate, force: Force, drive: Drive) -> Step:
    """The step of a plant that gives its response: ``substeps`` of h [s].

    The external force is that of a substep's start, and is held over it as the effort is.
    """

    def step(
        constants: PlantConstants, memory: PlantMemory, work: PlantWork, t: float, effort: Vector
    ) -> int:
        q, v, driven, acting = work.position, work.velocity, work.driven, work.acting
        h, hit = constants.h, constants.disturbed
        n = len(q)
        if take_effort(drive, constants, memory, work, effort) != NONE:
            return EFFORT
        for substep in range(constants.substeps):
            for i in range(n):
                acting[i] = driven[i]
            acting[hit] += force(
                constants.disturbance, memory.disturbance, t + substep * h, h, q[hit], v[hit]
            )
            integrate(
                constants.integrator,
                constants.order,
                h,
                constants.coefficients,
                acting,
                q,
                v,
                work.response,
                work.integrator,
            )
            fault = fault_of(constants, work)
            if fault != NONE:
                return fault
        for i in range(n):
            memory.position[i], memory.velocity[i], memory.effort[i] = q[i], v[i], driven[i]
        return NONE

    return step


@cache
def by_itself(advance: Advance, force: Force, drive: Drive) -> Step:
    """The step of a plant that integrates itself; the acceleration is the velocity's difference."""

    def step(
        constants: PlantConstants, memory: PlantMemory, work: PlantWork, t: float, effort: Vector
    ) -> int:
        q, v, a, acted = work.position, work.velocity, work.response, work.acting
        external, h, hit = work.external, constants.h, constants.disturbed
        n = len(q)
        if take_effort(drive, constants, memory, work, effort) != NONE:
            return EFFORT
        for i in range(n):
            external[i] = 0.0
        for substep in range(constants.substeps):
            for i in range(n):
                a[i] = v[i]
            at = t + substep * h
            external[hit] = force(constants.disturbance, memory.disturbance, at, h, q[hit], v[hit])
            advance(constants.coefficients, memory.own, at, h, work.driven, external, q, v, acted)
            for i in range(n):
                a[i] = (v[i] - a[i]) / h
            fault = fault_of(constants, work)
            if fault != NONE:
                return fault
        for i in range(n):
            memory.position[i], memory.velocity[i], memory.effort[i] = q[i], v[i], acted[i]
        return NONE

    return step
