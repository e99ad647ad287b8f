"""What stages 1 and 6 compute: what the sensors show, and the motion that an effort causes."""

import math
from enum import IntEnum
from typing import NamedTuple

from fpt_ros.cycle.chains import AT_ACTUATORS, AT_SENSORS, Spoilt
from fpt_ros.cycle.rows import JointStatesRow
from fpt_ros.disturbances import Force
from fpt_ros.integrators import Integrate
from fpt_ros.laws import Indices, Matrix, MutableVector, Switch, Vector, helper
from fpt_ros.plants import Advance


class PlantConstants(NamedTuple):
    """Fixed.

    ``coefficients`` of the exact plant; constants of the ``disturbance``, which acts on the
    coordinate number ``disturbed``; limits beyond which the run is lost; standard deviations
    ``sigma_q``, ``sigma_v`` of the noise; ``h``: length of one of the ``substeps`` [s]; ``order``
    of the response; ``velocity_measured``; ``late``: cycles by which the sensors are; constants of
    the ``integrator``; of the disturbances of ``sensors`` and ``actuators``, a row each, and the
    coordinates that have them; ``dt``: length of a cycle [s]; ``by_itself``: whether the plant
    integrates itself.
    """

    coefficients: Vector
    disturbance: Vector
    position_limit: Vector
    acceleration_limit: float
    sigma_q: float
    sigma_v: float
    h: float
    substeps: int
    order: Switch
    disturbed: int
    velocity_measured: Switch
    late: int
    dt: float
    integrator: Vector
    sensors: Matrix
    sensors_at: Indices
    actuators: Matrix
    actuators_at: Indices
    by_itself: Switch


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

    ``driven``: the efforts that come out of the actuators; ``acting``: with the external force, or
    as a plant that integrates itself reports them.
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


@helper
def measure(
    spoil: Spoilt,
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
    if cycle > 0 and len(constants.sensors) > 0:
        where, dt = constants.sensors_at, constants.dt
        spoil(AT_SENSORS, constants.sensors, memory.sensors, dt, where, q, v)


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


@helper
def move(
    spoil: Spoilt,
    force: Force,
    integrate: Integrate,
    advance: Advance,
    constants: PlantConstants,
    memory: PlantMemory,
    work: PlantWork,
    t: float,
    effort: Vector,
) -> int:
    """One cycle of the plant from t [s], the effort held: ``substeps`` of h [s].

    A plant that gives its response is integrated; the external force is that of a substep's
    start, and is held over it as the effort is. Where a plant integrates itself, its acceleration
    is the difference of its velocity.

    Returns:
        what went wrong (:class:`Fault`). The memory stays as it is then, but for the disturbance's
        and the plant's own.
    """
    q, v, a, driven, acting = work.position, work.velocity, work.response, work.driven, work.acting
    h, hit, n = constants.h, constants.disturbed, len(effort)
    for i in range(n):
        q[i], v[i], driven[i] = memory.position[i], memory.velocity[i], effort[i]
        work.external[i] = 0.0
        if not math.isfinite(effort[i]):
            work.place[0] = i
            return EFFORT
    if len(constants.actuators) > 0:
        where, dt = constants.actuators_at, constants.dt
        spoil(AT_ACTUATORS, constants.actuators, memory.actuators, dt, where, driven, driven)
    for substep in range(constants.substeps):
        at = t + substep * h
        push = force(constants.disturbance, memory.disturbance, at, h, q[hit], v[hit])
        if constants.by_itself:
            for i in range(n):
                a[i] = v[i]
            work.external[hit] = push
            advance(constants.coefficients, memory.own, at, h, driven, work.external, q, v, acting)
            for i in range(n):
                a[i] = (v[i] - a[i]) / h
        else:
            for i in range(n):
                acting[i] = driven[i]
            acting[hit] += push
            integrate(
                constants.integrator,
                constants.order,
                h,
                constants.coefficients,
                acting,
                q,
                v,
                a,
                work.integrator,
            )
        fault = fault_of(constants, work)
        if fault != NONE:
            return fault
    for i in range(n):
        memory.position[i], memory.velocity[i] = q[i], v[i]
        memory.effort[i] = acting[i] if constants.by_itself else driven[i]
    return NONE


def not_integrated(
    constants: Vector,
    order: int,
    h: float,
    coefficients: Vector,
    effort: Vector,
    q: MutableVector,
    v: MutableVector,
    a: MutableVector,
    work: MutableVector,
) -> None:
    """In the place of an integrator, for a plant that integrates itself."""


def not_advanced(
    coefficients: Vector,
    state: MutableVector,
    t: float,
    dt: float,
    effort: Vector,
    external: Vector,
    q: MutableVector,
    v: MutableVector,
    acted: MutableVector,
) -> None:
    """In the place of ``Plant.advance``, for a plant that is integrated."""
