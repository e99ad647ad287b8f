"""What stage 4 computes: what is tuned in a cycle, and what is kept for the next one."""

import math
from typing import NamedTuple

from fpt_ros.cycle.rows import Commanded, Estimated, TuningRow, Wanted
from fpt_ros.laws import Indices, MutableVector, Switch, Vector, helper
from fpt_ros.messages.frames import Command
from fpt_ros.plants import Regressor
from fpt_ros.tuning import Seen, Update
from fpt_ros.tuning.precursor import guarded, observe

FIRST, WATCHING, TUNING_NOW = 0, 1, 2
"""Phases of a tuner: no command has been seen yet; only the observer runs; the law runs too."""


class TunerConstants(NamedTuple):
    """Fixed: constants of law and model, places of the controlled coordinates (where needed).

    ``reference``: Y is taken at the reference motion; ``guards``: the precursor guard acts;
    ``signals``: how many numbers of the law's memory are published; ``tune_from`` [s].
    """

    law: Vector
    model: Vector
    where: Indices
    reference: Switch
    guards: Switch
    signals: int
    tune_from: float


class TunerMemory(NamedTuple):
    """What is tuned, the law's memory, and the cycle before.

    Of the cycle before: ``position``, ``velocity`` (n each), ``desired`` response (c) and
    ``tracking``: e, e', s (c each). ``factor`` of the gain (1), ``observer``: the precursor
    observer's memory.
    """

    values: MutableVector
    law: MutableVector
    position: MutableVector
    velocity: MutableVector
    desired: MutableVector
    tracking: MutableVector
    factor: MutableVector
    observer: MutableVector


class TunerWork(NamedTuple):
    """Velocity and acceleration at which Y is taken (n each), Y, E, the response error h (c)."""

    w: MutableVector
    a: MutableVector
    Y: MutableVector
    error: MutableVector
    h: MutableVector


@helper
def tune(
    update: Update,
    regressor: Regressor,
    constants: TunerConstants,
    memory: TunerMemory,
    work: TunerWork,
    dt: float,
    estimate: Estimated,
    desired: Wanted,
    command: Commanded,
) -> None:
    """One cycle of a tuning law: Y and E of the cycle before, now that its response is known."""
    response, wanted, where = estimate.accelerations, desired.accelerations, constants.where
    w, a, Y, error, h = work.w, work.a, work.Y, work.error, work.h
    values, tracking = memory.values, memory.tracking
    c = len(where)
    for i in range(len(w)):
        w[i], a[i] = memory.velocity[i], response[i]
    for i in range(c):
        at = where[i]
        h[i] = response[at] - wanted[i]
        if constants.reference:
            w[at] = memory.velocity[at] + tracking[2 * c + i]
            a[at] = memory.desired[i]
    if len(Y) > 0:
        size = len(values)
        regressor(constants.model, memory.position, memory.velocity, w, a, Y)
        for i in range(len(error)):
            total = 0.0
            for j in range(size):
                total += Y[i * size + j] * values[j]
            error[i] = command.effort[i] - total
    seen = Seen(Y, error, tracking, h, command.accelerations)
    update(constants.law, memory.law, dt, values, seen)


@helper
def remember(
    constants: TunerConstants, memory: TunerMemory, estimate: Estimated, desired: Wanted
) -> None:
    """Keep what the next cycle needs of this one."""
    q, v, where = estimate.positions, estimate.velocities, constants.where
    tracking = memory.tracking
    c = len(where)
    for i in range(len(q)):
        memory.position[i], memory.velocity[i] = q[i], v[i]
    for i in range(c):
        at = where[i]
        memory.desired[i] = desired.accelerations[i]
        tracking[i] = desired.positions[i] - q[at]
        tracking[c + i] = desired.velocities[i] - v[at]
        tracking[2 * c + i] = desired.combined_error[i]


@helper
def answered(response: Vector) -> bool:
    """Whether the response is known: of a lost sample it is not."""
    known = True
    for x in response:
        known = known and not math.isnan(x)
    return known


@helper
def tuning_cycle(
    update: Update,
    regressor: Regressor,
    constants: TunerConstants,
    memory: TunerMemory,
    work: TunerWork,
    phase: int,
    dt: float,
    estimate: Estimated,
    desired: Wanted,
    command: Commanded,
    out: TuningRow,
) -> None:
    """All of the stage: observer and guard, the law, what is kept, and what is published."""
    if phase != FIRST:
        index = observe(memory.observer, command.accelerations)
        if constants.guards:
            memory.factor[0] = guarded(memory.factor[0], index)
    if phase == TUNING_NOW and answered(estimate.accelerations):
        tune(update, regressor, constants, memory, work, dt, estimate, desired, command)
    remember(constants, memory, estimate, desired)
    size, signals, values = len(memory.values), constants.signals, out.values
    for i in range(size):
        values[i] = memory.values[i]
    for i in range(signals):
        values[size + i] = memory.law[i]
    values[size + signals] = memory.observer[0]
    values[size + signals + 1] = memory.factor[0]


@helper
def phase_of(first: bool, before: float, tune_from: float) -> int:
    """The tuner's phase; ``before``: time of the cycle before [s]."""
    if first:
        return FIRST
    return TUNING_NOW if before >= tune_from else WATCHING


@helper
def no_regressor(c: Vector, q: Vector, v: Vector, w: Vector, a: Vector, out: MutableVector) -> None:
    """In the place of a regressor where none is needed."""


NO_COMMAND = Command(-1, (), (), ())
"""In the place of the command before the first one, at which nobody looks."""
